import { describe, expect, it } from "vitest";
import { pairFromClicks, parseDirective, directiveText, withoutPair, withPair } from "./orientation";

const up = { direction: "+Z", from: "Is(leg)", to: "Is(panel)" };
const front = { direction: "+X", from: "All", to: 'Is("front, door")' };

describe("the text of an orientation", () => {
  it.each(["", "+Z: Is(leg) -> Is(panel)", 'snap +Z: Is(leg) -> Is(panel), +X: All -> Is("front, door")'])(
    "is read and written again: %j",
    (text) => {
      const read = parseDirective(text);
      expect(read && directiveText(read)).toBe(text);
    },
  );

  it("may have the word orient before it", () => {
    expect(parseDirective("orient snap +Z: Is(leg)->Is(panel)")).toEqual({ snap: true, pairs: [up] });
  });

  it.each(["+Z", "+Z: Is(leg) -> ", "Is(a) -> Is(b)", "+Z: Is(leg) -> Is(panel) +X: All -> All"])(
    "is not understood: %j",
    (text) => {
      expect(parseDirective(text)).toBeNull();
    },
  );
});

describe("a clicked direction", () => {
  it("takes the place of the one along the same axis", () => {
    const before = { snap: true, pairs: [up, front] };
    const down = { direction: "-Z", from: "Is(a)", to: "Is(b)" };
    expect(withPair(before, down)).toEqual({ snap: true, pairs: [down, front] });
  });

  it("comes second, and never third", () => {
    expect(withPair({ snap: false, pairs: [up] }, front).pairs).toEqual([up, front]);
    const side = { ...front, direction: "+Y" };
    expect(withPair({ snap: false, pairs: [up, front] }, side).pairs).toEqual([up, side]);
  });

  it("is set by two different labels", () => {
    expect(pairFromClicks("+Z", "leg", "table top")).toEqual({ direction: "+Z", from: "Is(leg)", to: 'Is("table top")' });
    expect(pairFromClicks("+Z", "leg", null)).toMatch(/label it first/);
    expect(pairFromClicks("+Z", "leg", "leg")).toMatch(/two different labels/);
  });

  it("can be taken away", () => {
    expect(directiveText(withoutPair({ snap: true, pairs: [up] }, 0))).toBe("");
  });
});
