// What the server says of the language: asked for once, kept for the page's life.
import { create } from "zustand";
import { api } from "../server/api";
import type { ActionForm, LanguageView } from "../wire";
import { complainedOf } from "./toasts";

export const useLanguage = create<{ language: LanguageView | null }>()(() => ({ language: null }));

let asked: Promise<LanguageView> | null = null;

/** The language; a request that failed is made again the next time. */
export function language(): Promise<LanguageView> {
  asked ??= api.language().then(
    (view) => {
      useLanguage.setState({ language: view });
      return view;
    },
    (error: unknown) => {
      asked = null;
      throw error;
    },
  );
  return asked;
}

/** Fetches the language for a part of the page that waits for it. */
export function askLanguage(): void {
  language().catch(complainedOf);
}

export function formOf(action: string, forms: readonly ActionForm[]): ActionForm | undefined {
  return forms.find((form) => form.name === action);
}
