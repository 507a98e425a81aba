// Labels that are there already: in files beside the assets, and in the names of hulls and bodies.
import { FileText, Type } from "lucide-react";
import { useEffect, useState } from "react";
import { api } from "../../server/api";
import { perform } from "../../store/edits";
import { useProject } from "../../store/project";
import { complainedOf } from "../../store/toasts";
import { counted } from "../../store/words";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import css from "./label.module.css";

export function LabelSources() {
  const { files, names } = useSources();
  if (!files && !names) return null;
  return (
    <Section title="Labels that are there already">
      <div className={css.sources}>
        {files > 0 && (
          <Button
            icon={FileText}
            onClick={() => void perform({ kind: "label-files" })}
            tip="Take over the labels files that lie beside the assets"
          >
            From files beside {counted(files, "asset")}
          </Button>
        )}
        {names > 0 && (
          <Button
            icon={Type}
            onClick={() => void perform({ kind: "label-names" })}
            tip="Where the name of a hull or of its body holds a label"
          >
            From names ({counted(names, "hull")})
          </Button>
        )}
      </div>
    </Section>
  );
}

/** How much there is, asked anew when labels or assets change. */
function useSources(): { files: number; names: number } {
  const [sources, setSources] = useState({ files: 0, names: 0 });
  const vocabulary = useProject((state) => state.project.vocabulary);
  const assets = useProject((state) => state.order.length);
  useEffect(() => {
    let is = true;
    const timer = setTimeout(() => {
      api.labelSources().then((found) => is && setSources(found), complainedOf);
    }, 250);
    return () => {
      is = false;
      clearTimeout(timer);
    };
  }, [vocabulary, assets]);
  return sources;
}
