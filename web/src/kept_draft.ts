// What somebody dropped or typed and has not handed in outlives a reload. What is typed is kept at once by the tab,
// which reads it without waiting; files are kept by the browser's database, which is still writing when a key is
// followed by a reload.

import { useState } from "preact/hooks";
import { openedRun } from "./api";

const keyOf = (name: string) => `${openedRun()}/${name}`;

const TYPED = "nacre.draft.";
const typed = new Map<string, unknown>();

/** What was typed in this tab, before a reload too; undefined: nothing. */
export function keptTyping<T>(name: string): T | undefined {
  const key = keyOf(name);
  if (typed.has(key)) return typed.get(key) as T;
  try {
    return JSON.parse(sessionStorage.getItem(TYPED + key) ?? "") as T;
  } catch {
    return undefined;
  }
}

/** Keeps what was typed, or with undefined forgets it. */
export function keepTyping(name: string, value: unknown): void {
  const key = keyOf(name);
  typed.set(key, value);
  try {
    if (value === undefined) sessionStorage.removeItem(TYPED + key);
    else sessionStorage.setItem(TYPED + key, JSON.stringify(value));
  } catch {
    // A long curve may not fit: it stays as long as the page does.
  }
}

/** State of a run that outlives its view and a reload: what somebody has typed and not submitted. */
export function useDraft<T>(draft: string, initial: T): [T, (value: T | ((now: T) => T)) => void] {
  const [value, setValue] = useState<T>(() => keptTyping<T>(draft) ?? initial);
  return [
    value,
    (next) =>
      setValue((now) => {
        const chosen = typeof next === "function" ? (next as (now: T) => T)(now) : next;
        keepTyping(draft, chosen);
        return chosen;
      }),
  ];
}

const STORE = "drafts";

function database(): Promise<IDBDatabase> {
  return new Promise((done, fail) => {
    const asked = indexedDB.open("nacre", 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore(STORE);
    asked.onsuccess = () => done(asked.result);
    asked.onerror = () => fail(asked.error);
  });
}

async function inStore(mode: IDBTransactionMode, act: (store: IDBObjectStore) => IDBRequest): Promise<unknown> {
  const opened = await database();
  try {
    return await new Promise((done, fail) => {
      const transaction = opened.transaction(STORE, mode);
      const asked = act(transaction.objectStore(STORE));
      transaction.oncomplete = () => done(asked.result);
      transaction.onerror = transaction.onabort = () => fail(transaction.error);
    });
  } finally {
    opened.close();
  }
}

/** The draft of the opened run; undefined where there is none. */
export const keptDraft = <T>(name: string) =>
  inStore("readonly", (store) => store.get(keyOf(name))) as Promise<T | undefined>;

/** Keeps a draft, or with undefined forgets it. */
export const keepDraft = (name: string, draft: unknown) =>
  inStore("readwrite", (store) =>
    draft === undefined ? store.delete(keyOf(name)) : store.put(draft, keyOf(name)));
