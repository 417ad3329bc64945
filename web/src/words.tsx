// The glossary of nacre (docs/GLOSSARY.md), as a view that can be searched.

import type { ComponentChildren } from "preact";
import { useMemo, useState } from "preact/hooks";
import glossary from "../../docs/GLOSSARY.md";

/** A row of a table, an item of a list, or a paragraph: its cells, in Markdown. */
interface Section {
  title: string;
  heading: string[];
  rows: string[][];
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
  let section: Section = { title: "", heading: [], rows: [] };
  const isTable = (line: string) => line.trimStart().startsWith("|");
  const lines = markdown.split("\n");
  lines.forEach((line, i) => {
    const title = /^#+\s+(.*)/.exec(line)?.[1];
    if (title) sections.push((section = { title, heading: [], rows: [] }));
    else if (isTable(line) && /^[\s|:-]+$/.test(line)) section.heading = section.rows.pop() ?? [];
    else if (isTable(line)) section.rows.push(cellsOf(line));
    else if (/^\s*- /.test(line)) section.rows.push([line.replace(/^\s*- /, "")]);
    else if (line.trim() !== "" && i > 0 && lines[i - 1].trim() !== "" && section.rows.at(-1)?.length === 1)
      section.rows.at(-1)![0] += ` ${line.trim()}`;
    else if (line.trim() !== "") section.rows.push([line.trim()]);
  });
  return sections.filter((s) => s.rows.length > 0);
}

/** Bold, emphasis and code; links as their text, since they lead to files of the project. */
function inline(markdown: string): ComponentChildren[] {
  const plain = markdown.replace(/\[([^\]]*)\]\([^)]*\)/g, "$1");
  return plain.split(/(\*\*[^*]+\*\*|\*[^*]+\*|`[^`]+`)/).map((part) => {
    if (part.startsWith("**")) return <strong>{part.slice(2, -2)}</strong>;
    if (part.startsWith("*")) return <em>{part.slice(1, -1)}</em>;
    if (part.startsWith("`")) return <code class="key">{part.slice(1, -1)}</code>;
    return part;
  });
}

function Rows({ section }: { section: Section }) {
  const columns = Math.max(...section.rows.map((row) => row.length));
  return (
    <div class="wide glossary">
      <table>
        {section.heading.length > 0 && (
          <thead>
            <tr>
              {section.heading.map((cell) => (
                <th key={cell} scope="col" class="words">
                  {inline(cell)}
                </th>
              ))}
            </tr>
          </thead>
        )}
        <tbody>
          {section.rows.map((row, i) => (
            <tr key={i}>
              {row.map((cell, k) => (
                <td key={k} class="words" colSpan={k + 1 === row.length ? columns - k : 1}>
                  {inline(cell)}
                </td>
              ))}
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
    .map((s) => ({ ...s, rows: s.rows.filter((row) => row.join(" ").toLowerCase().includes(wanted)) }))
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
          <Rows section={section} />
        </details>
      ))}
    </section>
  );
}
