// Who approves, and why: kept with what is approved.

import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { useStored } from "./parts";

/** The words of an approval, and the fields that they are typed into. */
export function useApprover(user: string): { by: string; why: string; fields: ComponentChildren } {
  const [by, setBy] = useStored("by", user);
  const [why, setWhy] = useState("");
  const fields = (
    <>
      <label>
        You are <input required value={by} maxLength={60} onInput={(e) => setBy(e.currentTarget.value)} />
      </label>
      <label>
        Why{" "}
        <input
          value={why}
          maxLength={200}
          placeholder="kept with your approval"
          onInput={(e) => setWhy(e.currentTarget.value)}
        />
      </label>
    </>
  );
  return { by, why, fields };
}
