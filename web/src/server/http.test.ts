import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "./api";
import { getBlob, getBytes, getJson, page, postForBytes, postJson, putBytes, ServerProblem, setToken, socketProtocols } from "./http";

interface Call {
  path: string;
  init: RequestInit & { headers: Record<string, string> };
}

let calls: Call[] = [];

/** Answers every request the same way, and notes it. */
function answer(body: BodyInit | null, status = 200): void {
  vi.stubGlobal("fetch", async (path: string, init: Call["init"]) => {
    calls.push({ path, init });
    return new Response(body, { status });
  });
}

async function problemOf(request: Promise<unknown>): Promise<ServerProblem> {
  const error: unknown = await request.then(
    () => undefined,
    (reason: unknown) => reason,
  );
  if (!(error instanceof ServerProblem)) throw new Error(`no problem of the server: ${String(error)}`);
  return error;
}

beforeEach(() => {
  calls = [];
  setToken("secret");
});

afterEach(() => {
  vi.unstubAllGlobals();
  setToken("");
});

describe("a request", () => {
  it("carries the token and the page that it comes from", async () => {
    answer("{}");
    await getJson("api/language");
    expect(calls[0]?.init.headers).toEqual({ Authorization: "Bearer secret", "X-Page": page });
  });

  it("never has the token in its address", async () => {
    answer("{}");
    await getJson("api/asset", { asset: "a/b c.urdf", steps: 2 });
    expect(calls[0]?.path).toBe("api/asset?asset=a%2Fb+c.urdf&steps=2");
  });

  it("has no question mark without a query", async () => {
    answer("{}");
    await getJson("api/language");
    expect(calls[0]?.path).toBe("api/language");
  });

  it("sends its body as JSON", async () => {
    answer('{"said":"done"}');
    expect(await postJson("api/edit", { kind: "label", hulls: ["x"] })).toEqual({ said: "done" });
    const { method, body, headers } = calls[0]?.init ?? {};
    expect([method, body, headers?.["Content-Type"]]).toEqual(["POST", '{"kind":"label","hulls":["x"]}', "application/json"]);
  });

  it("uploads a file as it is, with its path in the query", async () => {
    answer('{"names":["tray.obj"]}');
    const file = new Blob(["v 0 0 0"]);
    expect(await putBytes("api/assets", { path: "tray.obj" }, file)).toEqual({ names: ["tray.obj"] });
    expect([calls[0]?.path, calls[0]?.init.method, calls[0]?.init.body]).toEqual(["api/assets?path=tray.obj", "PUT", file]);
  });

  it("gives bytes where they are asked for", async () => {
    answer(new Uint8Array([1, 2, 3]));
    expect([...new Uint8Array(await getBytes("api/shapes", { asset: "a" }))]).toEqual([1, 2, 3]);
    expect([...new Uint8Array(await postForBytes("api/preview", {}))]).toEqual([1, 2, 3]);
  });

  it("can be stopped", async () => {
    answer("{}");
    const stop = new AbortController();
    await postJson("api/select", {}, stop.signal);
    await getJson("api/checked", {}, stop.signal);
    expect(calls.map(({ init }) => init.signal)).toEqual([stop.signal, stop.signal]);
  });
});

describe("a failure", () => {
  it("has the message and the remedy of the server", async () => {
    answer('{"message":"no such asset","where":"a","remedy":"open another","conflict":false}', 404);
    const { problem, status, message } = await problemOf(getJson("api/asset"));
    expect([problem.message, problem.where, problem.remedy, status]).toEqual(["no such asset", "a", "open another", 404]);
    expect(message).toBe("no such asset");
  });

  it("has a message even where the answer is no JSON", async () => {
    answer("<html>Bad gateway</html>", 502);
    expect((await problemOf(postJson("api/edit", {}))).problem.message).toBe("The server answered 502.");
  });

  it("says how to start the server where it does not answer", async () => {
    vi.stubGlobal("fetch", async () => {
      throw new TypeError("Failed to fetch");
    });
    const { problem, status } = await problemOf(getJson("api/asset"));
    expect(status).toBe(0);
    expect(problem.remedy).toContain("meshforge studio");
  });

  it("is none of the server where the page stopped the request itself", async () => {
    const stopped = new DOMException("stopped", "AbortError");
    vi.stubGlobal("fetch", async () => {
      throw stopped;
    });
    await expect(getJson("api/asset")).rejects.toBe(stopped);
  });
});

it("offers the token of a socket beside its protocol, where it can be one", () => {
  expect(socketProtocols()).toEqual(["meshforge", "secret"]);
  setToken("no token, at all");
  expect(socketProtocols()).toEqual(["meshforge"]);
});

it("fetches pictures with the token in a header, too", async () => {
  answer(new Uint8Array([1]));
  expect((await getBlob(api.thumbnail("a&b", "source", "1"))).size).toBe(1);
  expect(calls[0]?.path).toBe("api/thumbnail?asset=a%26b&of=source&v=1");
  expect(calls[0]?.init.headers.Authorization).toBe("Bearer secret");
});
