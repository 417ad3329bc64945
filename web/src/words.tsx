// The glossary of nacre (docs/GLOSSARY.md), as a view that can be searched.

import type { ComponentChildren } from "preact";
import { useMemo, useState } from "preact/hooks";
import glossary from "../../docs/GLOSSARY.md";

/** A row of a table, an item of a list, or a paragraph: its cells, in Markdown. */
interface Row {
  cells: string[];
  isHeading: boolean;
}

interface Section {
  title: string;
  rows: Row[];
}

const cellsOf = (line: string) =>
  line
    .trim()
    .replace(/^\||\|$/g, "")
    .split("|")
    .map((cell) => cell.trim());

/** Sections of a page in Markdown; what is no table becomes rows of one cell. */
export function sectionsOf(markdown: string): Section[] {
  const sections: Section[] = [];
  let section: Section = { title: "", rows: [] };
  let isOpen = false; // whether the last row goes on in the next line
  const add = (cells: string[]) => section.rows.push({ cells, isHeading: false });
  for (const line of markdown.split("\n")) {
    const title = /^#+\s+(.*)/.exec(line)?.[1];
    const isTable = line.trimStart().startsWith("|");
    const last = section.rows.at(-1);
    if (title) sections.push((section = { title, rows: [] }));
    else if (isTable && /^[\s|:-]+$/.test(line)) last && (last.isHeading = true);
    else if (isTable) add(cellsOf(line));
    else if (/^\s*- /.test(line)) add([line.replace(/^\s*- /, "")]);
    else if (line.trim() !== "" && isOpen && last) last.cells[0] += ` ${line.trim()}`;
    else if (line.trim() !== "") add([line.trim()]);
    isOpen = line.trim() !== "" && !title && !isTable;
  }
  return sections.filter((s) => s.rows.length > 0);
}

/** Bold, emphasis and code; links as their text, since they lead to files of the project. */
function inline(markdown: string): ComponentChildren[] {
  const plain = markdown.replace(/\[([^\]]*)\]\([^)]*\)/g, "$1");
  return plain.split(/(\*\*[^*]+\*\*|\*[^*]+\*|`[^`]+`)/).map((part) => {
    if (part.startsWith("**")) return <strong>{inline(part.slice(2, -2))}</strong>;
    if (part.startsWith("*")) return <em>{inline(part.slice(1, -1))}</em>;
    if (part.startsWith("`")) return <code class="key">{part.slice(1, -1)}</code>;
    return part;
  });
}

function Rows({ rows }: { rows: Row[] }) {
  const columns = Math.max(...rows.map((row) => row.cells.length));
  return (
    <div class="wide glossary">
      <table>
        <tbody>
          {rows.map(({ cells, isHeading }, i) => (
            <tr key={i}>
              {cells.map((cell, k) => {
                const span = k + 1 === cells.length ? columns - k : 1;
                return isHeading ? (
                  <th key={k} scope="col" class="words" colSpan={span}>
                    {inline(cell)}
                  </th>
                ) : (
                  <td key={k} class="words" colSpan={span}>
                    {inline(cell)}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

export function WordsView() {
  const [find, setFind] = useState("");
  const sections = useMemo(() => sectionsOf(glossary), []);
  const wanted = find.trim().toLowerCase();
  const found = sections
    .map((s) => ({ ...s, rows: s.rows.filter(({ cells }) => cells.join(" ").toLowerCase().includes(wanted)) }))
    .filter((s) => s.rows.length > 0);
  return (
    <section class="panel words-view">
      <div class="panel-head">
        <h2>Words</h2>
        <label>
          Find{" "}
          <input type="search" value={find} onInput={(e) => setFind(e.currentTarget.value)} placeholder="toughness" />
        </label>
      </div>
      {found.length === 0 && <p class="awaited">No word contains “{find}”.</p>}
      {found.map((section) => (
        <details key={section.title} open>
          <summary>{section.title}</summary>
          <Rows rows={section.rows} />
        </details>
      ))}
    </section>
  );
}
