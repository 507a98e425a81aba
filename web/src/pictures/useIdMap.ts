// The decoded picture behind an address or a PNG, as soon as it is there.
import { useEffect, useState } from "react";
import { useProject } from "../store/project";
import type { IdMap } from "./idmap";
import { decoded, known, wanted } from "./store";

export type Source = { url: string; png?: undefined } | { url?: undefined; png: Blob };

interface Had {
  map: IdMap | null;
  /** What the map is of. */
  of: string | Blob | undefined;
}

/** failed: it could not be had. current: whether the map is of what is asked for, not of what was before. */
export function useIdMap({ url, png }: Source): { map: IdMap | null; current: boolean; failed: boolean } {
  const [{ map, of }, setMap] = useState<Had>(() => ({ map: url === undefined ? null : known(url), of: url }));
  const [failed, setFailed] = useState(false);
  const connected = useProject((state) => state.connected);
  useEffect(() => {
    const there = url === undefined ? null : known(url);
    if (there) {
      setMap((had) => (had.map === there && had.of === url ? had : { map: there, of: url }));
      return setFailed(false);
    }
    let mounted = true;
    let drop: (() => void) | undefined;
    const good = (value: IdMap) => {
      if (!mounted) return;
      setMap({ map: value, of: png ?? url });
      setFailed(false);
    };
    const bad = () => mounted && setFailed(true);
    const ask = () => {
      if (png) return void decoded(png).then(good, bad);
      const asked = wanted(url);
      drop = asked.drop;
      asked.picture.then(good, bad);
    };
    // a card that is only scrolled past asks for nothing
    const timer = setTimeout(ask, png ? 0 : 50);
    return () => {
      mounted = false;
      clearTimeout(timer);
      drop?.();
    };
  }, [url, png, connected]);
  return { map, current: of === (png ?? url), failed };
}
