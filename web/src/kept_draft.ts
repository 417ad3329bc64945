// What somebody dropped or typed and has not handed in, files included, in the browser's database: it outlives a
// reload.

import { openedRun } from "./api";

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

const keyOf = (name: string) => `${openedRun()}/${name}`;

/** The draft of the opened run; undefined where there is none. */
export const keptDraft = <T>(name: string) =>
  inStore("readonly", (store) => store.get(keyOf(name))) as Promise<T | undefined>;

/** Keeps a draft, or with undefined forgets it. */
export const keepDraft = (name: string, draft: unknown) =>
  inStore("readwrite", (store) =>
    draft === undefined ? store.delete(keyOf(name)) : store.put(draft, keyOf(name)));
