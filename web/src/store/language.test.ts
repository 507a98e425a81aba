import { beforeEach, expect, it, vi } from "vitest";

// each test loads the modules anew, which takes long on a busy machine
vi.setConfig({ testTimeout: 30_000 });

const view = { actions: [{ name: "Delete" }, { name: "Merge" }], operators: [], directions: [] };

/** The module as a page has it that was just loaded. */
async function fresh(answers: (() => Promise<unknown>)[]) {
  vi.resetModules();
  const { api } = await import("../server/api");
  const asked = vi.spyOn(api, "language").mockImplementation(() => (answers.shift() ?? (() => Promise.reject(new Error("asked too often"))))() as never);
  return { ...(await import("./language")), asked, toasts: (await import("./toasts")).useToasts };
}

beforeEach(() => {
  vi.restoreAllMocks();
});

it("is asked for once, however many want it", async () => {
  const { getLanguage, asked, useLanguage } = await fresh([async () => view]);
  const [one, other] = await Promise.all([getLanguage(), getLanguage()]);
  expect(one).toBe(other);
  expect(await getLanguage()).toBe(one);
  expect(asked).toHaveBeenCalledOnce();
  expect(useLanguage.getState().language).toBe(one);
});

it("is asked for again after a failure", async () => {
  const { getLanguage, useLanguage } = await fresh([() => Promise.reject(new Error("gone")), async () => view]);
  await expect(getLanguage()).rejects.toThrow("gone");
  expect(useLanguage.getState().language).toBeNull();
  expect((await getLanguage()).actions).toHaveLength(2);
});

it("reports a failure to the person where a part of the page waits for it", async () => {
  const { loadLanguage, toasts } = await fresh([() => Promise.reject(new Error("gone"))]);
  loadLanguage();
  await vi.waitFor(() => expect(toasts.getState().toasts.map((toast) => toast.text)).toEqual(["gone"]));
});

it("knows the form of an action by its name", async () => {
  const { formOf, getLanguage } = await fresh([async () => view]);
  const { actions } = await getLanguage();
  expect(formOf("Merge", actions)?.name).toBe("Merge");
  expect(formOf("Fly", actions)).toBeUndefined();
});
