// The learn stage: how learning stands, what is asked, and the program rule by rule.
import { useProject } from "../../store/project";
import { Hint } from "./Hint";
import { LearnHead } from "./LearnHead";
import { NoProgram } from "./NoProgram";
import { ProgramSection } from "./ProgramSection";
import { QuestionCard } from "./QuestionCard";
import { Repairs } from "./Repairs";
import { SaidList } from "./SaidList";

export function LearnPanel() {
  const lesson = useProject((state) => state.lesson);
  return (
    <>
      <LearnHead />
      {lesson?.question && <QuestionCard key={lesson.question.id} question={lesson.question} />}
      {lesson && lesson.repairs.length > 0 && <Repairs repairs={lesson.repairs} />}
      {lesson && <NoProgram lesson={lesson} />}
      <ProgramSection />
      {lesson?.hint && <Hint hint={lesson.hint} />}
      <SaidList />
    </>
  );
}
