// What keys mean on the card of the open question, and how it keeps the focus from one question to the next.
import { createContext, type KeyboardEvent, useContext, useLayoutEffect, useRef } from "react";
import { notify } from "../../store/toasts";
import { listText } from "../../store/words";

/** What can be done with a question: its choices in order, and what Y, N, L and S do. */
export interface CardKeys {
  readonly choices?: readonly (() => void)[];
  readonly accept?: () => void;
  readonly reject?: () => void;
  readonly later?: () => void;
  readonly show?: () => void;
  /** Whether Enter takes the first choice; left out: yes. */
  readonly hasDefault?: boolean;
}

interface CardFocus {
  /** Set by the card that is there. */
  readonly keys: { current: CardKeys };
  /** Keeps the focus on the card's place while a reply takes the card away. */
  readonly hold: () => void;
}

export const CardFocusContext = createContext<CardFocus>({ keys: { current: {} }, hold: () => undefined });

const LETTERS: Readonly<Record<string, Exclude<keyof CardKeys, "choices" | "hasDefault">>> = { Y: "accept", N: "reject", L: "later", S: "show" };
const WORDS = { accept: "accepts", reject: "rejects", later: "puts off", show: "shows" } as const;

/** Tells what keys mean on a card, null for one that has none, and gives a function that does a thing and keeps the focus. */
export function useCardKeys(own: CardKeys | null): (run: (() => void) | undefined) => () => void {
  const { keys, hold } = useContext(CardFocusContext);
  const mine = useRef(own);
  useLayoutEffect(() => {
    mine.current = own;
    if (!own) return;
    keys.current = own;
    return () => {
      if (keys.current === mine.current) keys.current = {};
    };
  });
  return (run) => () => {
    hold();
    run?.();
  };
}

/** Says which keys a card has, for one that it has not. */
function sayKeys({ choices = [], ...letters }: CardKeys): void {
  const digits = choices.length ? [choices.length > 1 ? `1 to ${choices.length} choose` : "1 chooses"] : [];
  const own = Object.entries(LETTERS).flatMap(([key, does]) => (letters[does] ? `${key} ${WORDS[does]}` : []));
  if (digits.length + own.length) notify(`Here ${listText([...digits, ...own])}.`);
}

/** Does what a key means on the card; Enter takes the first choice where the card, and none of its buttons, has the focus. Digits and the
 * letters of cards mean nothing else here, also while none is there. */
export function pressOnCard(event: KeyboardEvent, keys: CardKeys, hold: () => void): void {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const isEnter = event.key === "Enter" && event.target === event.currentTarget;
  const key = isEnter ? (keys.choices?.length ? "1" : "Y") : event.key.toUpperCase();
  const letter = LETTERS[key];
  if (!letter && !/^[1-9]$/.test(key)) return;
  event.preventDefault();
  if (event.repeat) return; // a key that is held must not answer questions that nobody saw
  hold();
  if (isEnter && keys.hasDefault === false) return sayKeys(keys);
  ((letter ? keys[letter] : keys.choices?.[Number(key) - 1]) ?? (() => sayKeys(keys)))();
}
