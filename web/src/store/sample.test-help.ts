// A card for tests, which say only what matters to them.
import type { Card } from "../wire";

export const sampleCard = (change: Partial<Card> = {}): Card => ({
  asset: "a",
  hulls: 4,
  labels: [],
  unsure: [],
  given: 0,
  demonstrated: false,
  output: "none",
  after: null,
  after_labels: [],
  stale: [],
  error: null,
  flags: [],
  review: null,
  note: null,
  corrections: 0,
  sources: 0,
  prepared: [],
  picture: null,
  edited_picture: null,
  check: null,
  faults: null,
  ...change,
});
