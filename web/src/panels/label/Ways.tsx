// The ways to get labels other than by hand, each with what it would give.
import { useEffect, useState } from "react";
import { api } from "../../server/api";
import { useProject } from "../../store/project";
import { complainedOf } from "../../store/toasts";
import { Section } from "../../ui/Section";
import type { LabelSources } from "../../wire";
import { FromAssets } from "./FromAssets";
import { FromModel } from "./FromModel";
import { FromFiles, FromNames } from "./FromProject";
import css from "./ways.module.css";

export function Ways() {
  const { files, names, model } = useSources();
  return (
    <Section title="Ways to get labels">
      <ul className={css.ways}>
        <FromAssets />
        <FromFiles files={files} />
        <FromNames names={names} />
        <FromModel key={model?.name} model={model} />
      </ul>
    </Section>
  );
}

/** How much there is, asked anew when labels or assets change. */
function useSources(): LabelSources {
  const [sources, setSources] = useState<LabelSources>({ files: 0, names: 0, model: null });
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
