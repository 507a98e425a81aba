// Labels that are there already: in files beside the assets, and in the names of hulls and bodies.
import { FileText, Type } from "lucide-react";
import { perform } from "../../store/edits";
import { counted } from "../../store/words";
import { Button } from "../../ui/Button";
import { Way } from "./Way";

/** files: assets whose labels file says something that is not taken yet. */
export function FromFiles({ files }: { files: number }) {
  if (!files) return null;
  const beside = `beside ${counted(files, "asset")}`;
  const take = (
    <Button
      onClick={() => void perform({ kind: "label-files" })}
      aria-label={`From files ${beside}: take`}
      tip="Take over the labels files that lie beside the assets"
    >
      Take
    </Button>
  );
  return <Way icon={FileText} title="From files" text={beside} action={take} />;
}

/** names: hulls without a label whose names say one. */
export function FromNames({ names }: { names: number }) {
  if (!names) return null;
  const of = `of ${counted(names, "hull")} without a label`;
  const take = (
    <Button
      onClick={() => void perform({ kind: "label-names" })}
      aria-label={`From names ${of}: take`}
      tip="Where the name of a hull or of its body holds a label"
    >
      Take
    </Button>
  );
  return <Way icon={Type} title="From names" text={of} action={take} />;
}
