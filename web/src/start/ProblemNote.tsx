// What went wrong at one place of the start page, with what to do about it.
import { type Place, useStart } from "../store/start";
import { Note } from "../ui/Section";

export function ProblemNote({ place }: { place: Place }) {
  const found = useStart((state) => (state.problem?.place === place ? state.problem.problem : null));
  if (!found) return null;
  return (
    <Note mood="bad">
      {found.where && `${found.where}: `}
      {found.message.replace(/\.$/, "")}.{found.remedy && ` ${found.remedy}`}
    </Note>
  );
}
