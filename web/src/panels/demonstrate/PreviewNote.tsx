// What the action in hand would do, in words, or why it cannot be done.
import { useDesk } from "../../store/desk";
import { useDrafting } from "../../store/drafting";
import { usePreview } from "../../store/preview";
import { previewWords } from "../../store/stepWords";
import { Note } from "../../ui/Section";

export function PreviewNote({ lacking }: { lacking: string | null }) {
  const selected = useDesk((desk) => desk.selection.size);
  const header = usePreview((state) => state.preview?.header ?? null);
  const problem = useDrafting((state) => state.problem);
  if (lacking) return <Note>{lacking}</Note>;
  if (!selected) return <Note>Nothing is selected: click the hulls in the view.</Note>;
  if (problem) {
    return (
      <Note mood="bad">
        {problem.message} {problem.remedy}
      </Note>
    );
  }
  if (!header) return <Note>{selected === 1 ? "1 hull" : `${selected} hulls`} selected</Note>;
  const wrong = header.findings.filter((finding) => finding.severity === "error");
  return (
    <Note mood={wrong.length ? "warn" : "plain"}>
      <strong>{previewWords(selected, header)}</strong>
      {header.note && <p>{header.note}</p>}
      {wrong.map((finding, k) => (
        <p key={k}>
          {finding.hull && `${finding.hull}: `}
          {finding.text}
        </p>
      ))}
    </Note>
  );
}
