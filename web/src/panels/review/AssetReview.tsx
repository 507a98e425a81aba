// The result of the open asset: verdict, numbers, findings, what each rule did, and edits by hand.
import { useDesk } from "../../store/desk";
import { useProject } from "../../store/project";
import { Note, Section } from "../../ui/Section";
import { Checks } from "./checks/Checks";
import { Corrections } from "./Corrections";
import { Findings } from "./Findings";
import { NumbersTable } from "./NumbersTable";
import { Remarks } from "./Remarks";
import css from "./review.module.css";
import { Trace } from "./Trace";
import { useOf, useResult } from "./useResult";
import { VerdictSection } from "./VerdictSection";

export function AssetReview() {
  const asset = useDesk((state) => state.asset);
  const there = useProject((state) => asset !== null && asset in state.cards);
  if (asset === null || !there) return <p className={css.empty}>Open an asset in the family on the left.</p>;
  return <OneAsset key={asset} asset={asset} />;
}

function OneAsset({ asset }: { asset: string }) {
  const of = useOf(asset);
  const result = useResult(asset, of);
  const told = useProject((state) => state.cards[asset]?.error != null);
  const correcting = useDesk((state) => state.draft !== null);
  return (
    <>
      <VerdictSection asset={asset} />
      {correcting && <Corrections asset={asset} />}
      <Remarks asset={asset} />
      {result.kind === "problem" && !told && (
        <Section title="Result">
          <Note mood="bad">
            {result.problem.message}
            {result.problem.remedy && <p className={css.remedy}>{result.problem.remedy}</p>}
          </Note>
        </Section>
      )}
      {result.kind === "there" && result.scene.edit && (
        <>
          <NumbersTable before={result.scene.view.hulls} edit={result.scene.edit} />
          <Findings edit={result.scene.edit} />
          <Checks asset={asset} />
          <Trace asset={asset} of={result.of} edit={result.scene.edit} />
        </>
      )}
      {!correcting && <Corrections asset={asset} />}
    </>
  );
}
