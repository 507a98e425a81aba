// Files that the server makes and the browser saves: a zip of the results, or the report.
import { api } from "../server/api";
import { saveFrom } from "../server/save";
import type { Card, ConfidenceView, DownloadJob, Job } from "../wire";
import { makeFile } from "./jobs";
import { useProject } from "./project";
import { isSignedOff, isWritten } from "./reviews";
import { reportError } from "./toasts";
import { countText } from "./words";

/** Has a file made, and saved as soon as it is there, wherever the person is by then. */
export async function takeAway(request: Omit<DownloadJob, "kind">): Promise<void> {
  const id = await makeFile(request);
  if (id !== null && (await endOfJob(id))?.state === "done") await saveFile(id);
}

/** Saves what a job has made. */
export async function saveFile(job: string): Promise<void> {
  try {
    saveFrom(await api.downloadTicket(job));
  } catch (error) {
    reportError(error);
  }
}

/** The job when it is over; null where it goes, with its project. */
function endOfJob(id: string): Promise<Job | null> {
  return new Promise((resolve) => {
    let seen = false;
    const look = (): boolean => {
      const job = useProject.getState().jobs.find((one) => one.id === id);
      const over = job ? job.state !== "running" : seen;
      seen ||= job !== undefined;
      if (over) resolve(job ?? null);
      return over;
    };
    if (look()) return;
    const leave = useProject.subscribe(() => look() && leave());
  });
}

/** What a zip will hold, and how many held results are in it or not. */
export function describeResults(
  cards: readonly Card[],
  confidence: Readonly<Record<string, ConfidenceView>>,
  signedOnly: boolean,
): string {
  const written = cards.filter(isWritten);
  const inside = signedOnly ? written.filter((card) => isSignedOff(card, confidence[card.asset])) : written;
  const held = written.filter((card) => confidence[card.asset]?.state === "needs review" && card.review !== "accepted").length;
  const text = `${countText(inside.length, signedOnly ? "signed-off result" : "result")}, in a zip`;
  if (!held) return text;
  return signedOnly ? `${text}; ${held} held ${held === 1 ? "is" : "are"} not in it` : `${text}; ${held} of them held`;
}
