// Keys on the card of a question: replies, and nothing that the rest of the window means by them.
import { describe, expect, it, vi } from "vitest";
import { useToasts } from "../../store/toasts";
import { pressOnCard } from "./cardKeys";

function press(key: string, more: object = {}) {
  const keys = { choices: [vi.fn(), vi.fn()], accept: vi.fn(), reject: vi.fn(), later: vi.fn(), show: vi.fn() };
  const [preventDefault, hold] = [vi.fn(), vi.fn()];
  pressOnCard({ key, preventDefault, ctrlKey: false, altKey: false, metaKey: false, ...more } as never, keys, hold);
  const { choices, ...letters } = keys;
  const done = [...choices.map((run, k) => [String(k + 1), run] as const), ...Object.entries(letters)];
  return { done: done.flatMap(([name, run]) => (run.mock.calls.length ? [name] : [])), taken: preventDefault.mock.calls.length, held: hold.mock.calls.length };
}

describe("a key on the card", () => {
  it("replies, and the focus stays for the next question", () => {
    const done = ["1", "2", "y", "N", "l", "S", "Enter"].map((key) => press(key));
    expect(done.map((one) => one.done)).toEqual([["1"], ["2"], ["accept"], ["reject"], ["later"], ["show"], ["1"]]);
    expect(done.every((one) => one.taken === 1 && one.held === 1)).toBe(true);
  });

  it("means nothing else while no card is there, so that what is typed ahead moves no camera", () => {
    expect(press("7")).toEqual({ done: [], taken: 1, held: 1 });
    const [preventDefault, hold] = [vi.fn(), vi.fn()];
    pressOnCard({ key: "3", preventDefault } as never, {}, hold);
    expect(preventDefault).toHaveBeenCalledOnce();
  });

  it("Enter takes nothing where no choice is likely", () => {
    const choices = [vi.fn(), vi.fn()];
    pressOnCard({ key: "Enter", preventDefault: vi.fn() } as never, { choices, accept: choices[0] as never, hasDefault: false }, vi.fn());
    expect(choices[0]).not.toHaveBeenCalled();
  });

  it("that the card has not says which ones it has", () => {
    pressOnCard({ key: "y", preventDefault: vi.fn() } as never, { choices: [vi.fn(), vi.fn()], later: vi.fn() }, vi.fn());
    expect(useToasts.getState().toasts.at(-1)?.text).toBe("Here 1 to 2 choose and L puts off.");
  });

  it("leaves all other keys to the window, and Enter to a button", () => {
    expect(press("Enter", { target: "button" }).taken).toBe(0);
    for (const key of ["Tab", "x", "0", "Escape", "?"]) expect(press(key).taken).toBe(0);
    expect(press("y", { ctrlKey: true })).toEqual({ done: [], taken: 0, held: 0 });
  });
});
