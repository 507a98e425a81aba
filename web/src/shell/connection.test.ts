// The token of the address, why there is no connection, and where one was before the page was loaded again.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

// each test loads the modules anew, which takes long on a busy machine
vi.setConfig({ testTimeout: 30_000 });

class Storage {
  readonly kept = new Map<string, string>();
  getItem = (key: string) => this.kept.get(key) ?? null;
  setItem = (key: string, value: string) => void this.kept.set(key, value);
}

interface Socket {
  onopen: () => void;
  onclose: (event: { code: number }) => void;
  onmessage: (message: { data: string }) => void;
}

let storage: Storage;
let shared: Storage;
let socket: Socket;

/** The modules as a page has them that was just loaded. */
async function load() {
  vi.resetModules();
  const [connection, http, project, workspace, edits, help] = await Promise.all([
    import("./connection"),
    import("../server/http"),
    import("../store/project"),
    import("../store/workspace"),
    import("../store/edits"),
    import("../store/sample.test-help"),
  ]);
  return { ...connection, ...http, ...project, ...workspace, ...edits, ...help };
}

/** Answers the question whether the server is there; nothing else is to be had of it. */
function answer(status: number): void {
  const gone = '{"message":"no such asset","where":null,"remedy":null,"conflict":false}';
  const respond = (path: string) => (path === "api/token" ? new Response("{}", { status }) : new Response(gone, { status: 404 }));
  vi.stubGlobal("fetch", async (path: string) => respond(path));
}

const hello = (page: Awaited<ReturnType<typeof load>>, change: object = {}) => {
  const cards = ["a", "b"].map((asset) => page.sampleCard({ asset }));
  const { project, history, program } = page.emptyProject;
  const event = { kind: "hello", version: "1", project, cards, history, program, outcome: null, learning: false, reach: [], assessment: null, assessing: false, jobs: [], tour: false, engines: {}, language: page.emptyProject.language, leave: true, ...change };
  socket.onmessage({ data: JSON.stringify(event) });
};

beforeEach(() => {
  vi.useFakeTimers();
  storage = new Storage();
  vi.stubGlobal("sessionStorage", storage);
  shared = new Storage();
  vi.stubGlobal("localStorage", shared);
  vi.stubGlobal("document", { baseURI: "http://host/" });
  vi.stubGlobal("WebSocket", function (this: Socket) {
    // eslint-disable-next-line @typescript-eslint/no-this-alias
    socket = this;
  });
  answer(200);
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("the token", () => {
  const open = (address: string) => {
    const replaced: string[] = [];
    vi.stubGlobal("location", { href: address });
    vi.stubGlobal("history", { replaceState: (_state: unknown, _title: string, url: URL) => replaced.push(url.href) });
    return replaced;
  };

  it("is taken from the address, out of sight, and kept for the tab", async () => {
    const replaced = open("http://host/?token=secret&x=1");
    const page = await load();
    page.takeToken();
    expect(page.socketProtocols()).toEqual(["meshforge", "secret"]);
    expect(replaced).toEqual(["http://host/?x=1"]);
    open("http://host/?x=1");
    const again = await load();
    again.takeToken();
    expect(again.socketProtocols()).toEqual(["meshforge", "secret"]);
  });

  it("of the address counts more than the one that was kept", async () => {
    storage.setItem("meshforge.token", "old");
    open("http://host/?token=new");
    const page = await load();
    page.takeToken();
    expect(page.socketProtocols()).toEqual(["meshforge", "new"]);
  });

  it("is empty where there is none", async () => {
    open("http://host/");
    const page = await load();
    page.takeToken();
    expect(page.socketProtocols()).toEqual(["meshforge"]);
  });
});

describe("without a connection", () => {
  it("the page knows that it is lost, where the server answers again or not at all", async () => {
    const page = await load();
    page.connect();
    socket.onclose({ code: 1006 });
    await vi.waitFor(() => expect(page.useConnection.getState().state).toBe("lost"));
  });

  it.each([401, 403])("the page knows that the server is another one by its answer %i", async (status) => {
    answer(status);
    const page = await load();
    page.connect();
    socket.onclose({ code: 1006 });
    await vi.waitFor(() => expect(page.useConnection.getState().state).toBe("refused"));
  });

  it("the page is open again as soon as the server says what is open", async () => {
    const page = await load();
    page.connect();
    socket.onclose({ code: 1006 });
    socket.onopen();
    expect(page.useProject.getState().connected).toBe(false);
    hello(page);
    expect([page.useConnection.getState().state, page.useProject.getState().connected]).toEqual(["open", true]);
  });

  it.each([
    [{}, 400, "elsewhere", "/p: no project here"],
    [{ folder: "/other" }, 200, "elsewhere", "It has another project open: leave that one, and this page goes on by itself."],
    [{}, 200, "lost", undefined],
  ])("a page whose edits wait says why its project is not opened again: %j, %i", async (other, status, state, why) => {
    const page = await load();
    page.connect();
    hello(page, { project: { ...page.emptyProject.project, folder: "/p" } });
    socket.onclose({ code: 1006 });
    await vi.waitFor(() => expect(page.useConnection.getState().state).toBe("lost"));
    page.useUnsaved.setState({ count: 1 });
    const asked: string[] = [];
    vi.stubGlobal("fetch", async (path: string, { body }: RequestInit) => {
      asked.push(`${path} ${body as string}`);
      return new Response(JSON.stringify({ message: "no project here", where: "/p", remedy: null, conflict: false }), { status });
    });
    if ("folder" in other) hello(page, { project: { ...page.emptyProject.project, ...other } });
    else socket.onmessage({ data: JSON.stringify({ kind: "start", start: {} }) });
    await vi.advanceTimersByTimeAsync(1);
    expect(page.useConnection.getState()).toMatchObject({ state, ...(why && { why }) });
    expect(page.useProject.getState()).toMatchObject({ connected: false, project: { folder: "/p" } });
    expect(asked).toEqual("folder" in other ? [] : ['api/start/open {"folder":"/p"}']);
  });
});

const draft = { name: "Merge", arguments: {}, each: true, label: "leg", editing: 1 };

describe("the first word of the server", () => {
  it("opens what is next", async () => {
    const page = await load();
    page.connect();
    hello(page, { project: { ...page.emptyProject.project, next: { kind: "learn", text: "", asset: "b", command: null, note: null } } });
    expect([page.useWorkspace.getState().stage, page.useWorkspace.getState().asset]).toEqual(["learn", "b"]);
  });

  it("opens what was open before the page was loaded again", async () => {
    const before = await load();
    before.connect();
    hello(before);
    before.openStage("review");
    before.openAsset("b");
    const page = await load();
    page.connect();
    hello(page);
    expect([page.useWorkspace.getState().stage, page.useWorkspace.getState().asset]).toEqual(["review", "b"]);
  });

  it("opens in a new tab where the work is, of this project, without what is in hand in another tab", async () => {
    const before = await load();
    before.connect();
    hello(before);
    before.openStage("demonstrate");
    before.openAsset("b");
    before.setDraft(draft);
    vi.stubGlobal("sessionStorage", new Storage());
    const page = await load();
    page.connect();
    hello(page, { project: { ...page.emptyProject.project, next: { kind: "label", text: "", asset: "a", command: null, note: null } } });
    const { stage, asset, draft: inHand } = page.useWorkspace.getState();
    expect([stage, asset, inHand]).toEqual(["demonstrate", "b", null]);
    vi.stubGlobal("sessionStorage", new Storage());
    const other = await load();
    other.connect();
    hello(other, { project: { ...page.emptyProject.project, folder: "/other", next: { kind: "learn", text: "", asset: "a", command: null, note: null } } });
    expect(other.useWorkspace.getState().stage).toBe("learn");
  });

  it("gives back the action in hand with its hulls after the page was loaded again", async () => {
    const before = await load();
    before.connect();
    hello(before);
    before.openStage("demonstrate");
    before.openAsset("b");
    before.setDraft(draft);
    before.select(["x", "y"]);
    const page = await load();
    page.connect();
    hello(page);
    expect(page.useWorkspace.getState().draft).toEqual(draft);
    expect([...page.useWorkspace.getState().selection]).toEqual(["x", "y"]);
    page.setDraft(null);
    const after = await load();
    after.connect();
    hello(after);
    expect(after.useWorkspace.getState().draft).toBeNull();
  });

  it("gives back nothing that is no action in hand, or whose asset is gone", async () => {
    for (const hand of [{ draft: {} }, { draft, selection: 3 }, "x"]) {
      storage.setItem("meshforge.place", JSON.stringify({ asset: "b", stage: "demonstrate", hand }));
      const page = await load();
      page.connect();
      hello(page);
      expect(page.useWorkspace.getState().draft).toBeNull();
    }
    storage.setItem("meshforge.place", JSON.stringify({ asset: "gone", stage: "demonstrate", hand: { draft, selection: [] } }));
    const page = await load();
    page.connect();
    hello(page);
    expect(page.useWorkspace.getState().draft).toBeNull();
  });

  it("opens an asset that can be read where nothing else is known", async () => {
    storage.setItem("meshforge.place", '{"asset":"gone","stage":"dance"}');
    const page = await load();
    page.connect();
    const cards = [page.sampleCard({ asset: "a", error: "no mesh" }), page.sampleCard({ asset: "b" })];
    hello(page, { cards });
    expect([page.useWorkspace.getState().stage, page.useWorkspace.getState().asset]).toEqual(["label", "b"]);
  });

  it("leaves an asset that turns out to be unreadable, unless the person has opened another", async () => {
    const unread = { hulls: null, picture: null };
    for (const moved of [false, true]) {
      const page = await load();
      const cards = ["a", "b", "c"].map((asset) => page.sampleCard({ asset, ...unread }));
      page.connect();
      hello(page, { cards });
      expect(page.useWorkspace.getState().asset).toBe("a");
      if (moved) page.openAsset("b");
      page.receive({ kind: "cards", cards: [page.sampleCard({ asset: "a", ...unread, error: "no mesh" })], gone: [] });
      expect(page.useWorkspace.getState().asset).toBe(moved ? "b" : "a");
      page.receive({ kind: "cards", cards: [page.sampleCard({ asset: "c" })], gone: [] });
      expect(page.useWorkspace.getState().asset).toBe(moved ? "b" : "c");
      page.openAsset("a");
      page.receive({ kind: "cards", cards: [page.sampleCard({ asset: "b" })], gone: [] });
      expect(page.useWorkspace.getState().asset).toBe("a");
      storage.kept.clear();
      shared.kept.clear();
    }
  });

  it("is not disturbed by what was kept and cannot be read", async () => {
    storage.setItem("meshforge.place", "{broken");
    const page = await load();
    page.connect();
    hello(page);
    expect(page.useWorkspace.getState().asset).toBe("a");
  });

  it("counts once: a connection that comes back leaves the person where they are", async () => {
    const page = await load();
    page.connect();
    hello(page);
    page.openAsset("b");
    page.openStage("learn");
    hello(page);
    expect([page.useWorkspace.getState().stage, page.useWorkspace.getState().asset]).toEqual(["learn", "b"]);
  });
});
