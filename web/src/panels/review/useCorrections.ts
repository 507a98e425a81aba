// The edits by hand of an asset, also where its result fails.
import { useEffect, useState } from "react";
import { useProject } from "../../store/project";
import { details } from "../../store/scenes";
import type { CorrectionView } from "../../wire";

const NONE: readonly CorrectionView[] = [];

export function useCorrections(asset: string): readonly CorrectionView[] {
  const revision = useProject((state) => state.revisions[asset] ?? 0);
  const [got, setGot] = useState<{ asset: string; corrections: readonly CorrectionView[] } | null>(null);
  useEffect(() => {
    let wanted = true;
    details(asset).then(
      ({ view }) => wanted && setGot({ asset, corrections: view.corrections }),
      () => undefined, // the viewport tells of an asset that cannot be read
    );
    return () => {
      wanted = false;
    };
  }, [asset, revision]);
  return got?.asset === asset ? got.corrections : NONE;
}
