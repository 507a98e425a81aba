// Requests to the studio's server; every failure becomes a ServerProblem with a message and, if known, a remedy.
import type { Problem } from "../wire";

export class ServerProblem extends Error {
  /** act: what was asked for, as `answers` has it. */
  constructor(
    readonly problem: Problem,
    readonly status: number,
    readonly act: string | null = null,
  ) {
    super(problem.message);
  }
}

/** An error as a value, if the server has answered so. */
export function problemOf(error: unknown): ServerProblem {
  if (error instanceof ServerProblem) return error;
  throw error;
}

/** Who is called with each act that succeeds: an address, and of what is sent its kind and asset. */
export const answers = new Set<(act: string) => void>();

let token = "";
export const page = Math.random().toString(36).slice(2, 10);

/** Takes the token of the address, or the one this tab had before. */
export function setToken(given: string): void {
  token = given;
}

/** The protocols that a WebSocket asks for, which has no headers of its own; the token never stands in an address. */
export function socketProtocols(): string[] {
  return /^[\w-]+$/.test(token) ? ["meshforge", token] : ["meshforge"];
}

export async function getJson<T>(path: string, query: Record<string, string | number> = {}, stop?: AbortSignal): Promise<T> {
  return (await request(withQuery(path, query), { method: "GET", ...(stop ? { signal: stop } : {}) })).json() as Promise<T>;
}

export async function getBytes(path: string, query: Query = {}): Promise<ArrayBuffer> {
  return (await request(withQuery(path, query), { method: "GET" })).arrayBuffer();
}

export async function getBlob(path: string): Promise<Blob> {
  return (await request(path, { method: "GET" })).blob();
}

export async function postJson<T>(path: string, body: unknown, stop?: AbortSignal): Promise<T> {
  return (await request(path, postInit(body, stop))).json() as Promise<T>;
}

export async function postForBytes(path: string, body: unknown, stop?: AbortSignal): Promise<ArrayBuffer> {
  return (await request(path, postInit(body, stop))).arrayBuffer();
}

export async function putBytes<T>(path: string, query: Record<string, string>, body: Blob): Promise<T> {
  return (await request(withQuery(path, query), { method: "PUT", body })).json() as Promise<T>;
}

function postInit(body: unknown, stop?: AbortSignal): RequestInit {
  const init: RequestInit = { method: "POST", headers: { "Content-Type": "application/json" } };
  return { ...init, body: JSON.stringify(body), ...(stop ? { signal: stop } : {}) };
}

/** Of several values each is given by the same name. */
type Query = Readonly<Record<string, string | number | readonly string[]>>;

export function withQuery(path: string, query: Query): string {
  const pairs = Object.entries(query).flatMap(([key, value]) => [value].flat().map((one) => [key, String(one)]));
  const words = new URLSearchParams(pairs).toString();
  return words ? `${path}?${words}` : path;
}

async function request(path: string, init: RequestInit): Promise<Response> {
  const headers = { ...init.headers, Authorization: `Bearer ${token}`, "X-Page": page };
  let answer: Response;
  try {
    answer = await fetch(path, { ...init, headers });
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new ServerProblem(unreachable, 0);
  }
  const act = actOf(path, init);
  if (!answer.ok) throw new ServerProblem(await readProblem(answer), answer.status, act);
  for (const hear of answers) hear(act);
  return answer;
}

function actOf(path: string, { body }: RequestInit): string {
  if (typeof body !== "string") return path;
  const { kind, asset } = JSON.parse(body) as { kind?: unknown; asset?: unknown };
  return [path, kind, asset].filter((word) => typeof word === "string").join(" ");
}

const unreachable: Problem = {
  message: "The studio's server does not answer.",
  where: null,
  remedy: "Start it again in the terminal: meshforge studio. No confirmed edit is lost.",
  conflict: false,
};

async function readProblem(answer: Response): Promise<Problem> {
  try {
    return (await answer.json()) as Problem;
  } catch {
    return { message: `The server answered ${answer.status}.`, where: null, remedy: null, conflict: false };
  }
}
