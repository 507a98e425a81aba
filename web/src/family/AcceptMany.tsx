// Accepts several results at once, those that are legal.
import { CheckCheck } from "lucide-react";
import { useState } from "react";
import { acceptLegal } from "../commands/review";
import { Button } from "../ui/Button";

/** what: which results these are. */
export function AcceptMany({ assets, what, tip }: { assets: readonly string[]; what: string; tip: string }) {
  const [progress, setProgress] = useState<{ done: number; total: number } | null>(null);
  if (!assets.length && !progress) return null;
  const run = () => void acceptLegal(assets, (done, total) => setProgress({ done, total })).finally(() => setProgress(null));
  return (
    <Button icon={CheckCheck} disabled={progress !== null} tip={tip} onClick={run}>
      {progress ? `Checking ${progress.done} of ${progress.total}…` : `Accept all ${what} (${assets.length})`}
    </Button>
  );
}
