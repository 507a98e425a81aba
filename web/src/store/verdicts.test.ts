// Whether written outputs are legal, asked for a few at a time and kept as long as the output stays.
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { getVerdict, useVerdicts, verdictKey } from "./reviews";
import { sampleCard } from "./sample.test-help";

const result = (...severities: ("error" | "warning")[]) => ({ header: { findings: severities.map((severity) => ({ severity })) } }) as never;
let number = 0;
const card = (picture = "v1") => sampleCard({ asset: `asset ${number}`, output: "edited", edited_picture: picture });

beforeEach(() => {
  number += 1;
});

afterEach(() => {
  vi.restoreAllMocks();
});

it("is asked for once, and kept for the list of results", async () => {
  const asked = vi.spyOn(api, "result").mockResolvedValue(result());
  expect(await Promise.all([getVerdict(card()), getVerdict(card())])).toEqual(["legal", "legal"]);
  expect(asked).toHaveBeenCalledOnce();
  expect(useVerdicts.getState().verdicts[verdictKey(card())]).toBe("legal");
});

it("is asked for again for another output", async () => {
  const asked = vi.spyOn(api, "result").mockResolvedValueOnce(result("warning")).mockResolvedValueOnce(result("warning", "error"));
  expect(await getVerdict(card())).toBe("doubtful");
  expect(await getVerdict(card("v2"))).toBe("illegal");
  expect(asked).toHaveBeenCalledTimes(2);
});

it("is asked for again after a failure", async () => {
  vi.spyOn(api, "result").mockRejectedValueOnce(new Error("gone")).mockResolvedValueOnce(result());
  await expect(getVerdict(card())).rejects.toThrow("gone");
  await Promise.resolve();
  expect(await getVerdict(card())).toBe("legal");
});

it("is worked out for three outputs at once, and no more", async () => {
  let open = 0;
  let most = 0;
  vi.spyOn(api, "result").mockImplementation(async () => {
    most = Math.max(most, ++open);
    await new Promise((done) => setTimeout(done, 1));
    open -= 1;
    return result();
  });
  await Promise.all(Array.from({ length: 9 }, (_, k) => getVerdict(sampleCard({ asset: `many ${k}` }))));
  expect(most).toBe(3);
});
