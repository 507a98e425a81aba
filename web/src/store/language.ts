// What the server says of the language: asked for once, kept for the page's life.
import { create } from "zustand";
import { api } from "../server/api";
import type { ActionForm, LanguageView } from "../wire";
import { reportError } from "./toasts";

export const useLanguage = create<{ language: LanguageView | null }>()(() => ({ language: null }));

let request: Promise<LanguageView> | null = null;

/** The language; a request that failed is made again the next time. */
export function getLanguage(): Promise<LanguageView> {
  request ??= api.language().then(
    (view) => {
      useLanguage.setState({ language: view });
      return view;
    },
    (error: unknown) => {
      request = null;
      throw error;
    },
  );
  return request;
}

/** Fetches the language for a part of the page that waits for it. */
export function loadLanguage(): void {
  getLanguage().catch(reportError);
}

export function formOf(action: string, forms: readonly ActionForm[]): ActionForm | undefined {
  return forms.find((form) => form.name === action);
}
