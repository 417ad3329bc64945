// Finding, sorting and choosing on the page of a game that waits for a person, and what is entered from there.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { browser, leave, photograph, savedFrom, visit, visitWith } from "./browser.mjs";
import { endAll, openDashboard, playGame, ROOT, until } from "./games.mjs";

const game = await playGame(join(ROOT, "tests/web/live.toml"), "game");
const live = await openDashboard(game.folder);
after(async () => {
  await browser.close();
  endAll();
});

/** The round's proposals wait for a person from here on. */
const waiting = await visit(live.url);
await waiting.locator(".standing a", { hasText: /waits for you/ }).waitFor({ timeout: 120_000 });

const specimen = (i) => ({
  specimen: `s-${i}`,
  design: "577fffe9fffdef",
  test: i % 2 ? "toughness" : "modulus",
  orientation_deg: 0,
  strain_rate_per_s: 0.01,
  thickness_mm: 3.2,
  standard: true,
  batch: i < 4 ? "first" : "second",
  modulus_pa: i % 2 ? null : 1e9 * ((i * 7) % 12),
  toughness_pa: i % 2 ? 1e5 * ((i * 5) % 12) : null,
  points: 0,
  valid: true,
  note: "",
  by: "",
  why: "",
});

test("a table is put in order by its headings and narrowed by what it shall hold", async () => {
  const rows = Array.from({ length: 12 }, (_, i) => specimen(i));
  const on = await visitWith(`${live.url}#laboratory`, { "/api/laboratory": (work) => ({ ...work, specimens: rows }) });
  const table = on.locator(".table", { hasText: /^Review/ });
  const first = async () => (await table.locator("tbody tr td:first-child").allInnerTexts()).map((t) => t.trim());
  const heading = table.locator("th", { hasText: "E / GPa" });
  await table.locator("tbody tr").first().waitFor();
  assert.deepEqual(await first(), rows.map((r) => r.specimen));
  assert.equal(await heading.getAttribute("aria-sort"), "none");
  await heading.getByRole("button").focus();
  await on.keyboard.press("Enter");
  assert.equal(await heading.getAttribute("aria-sort"), "ascending");
  // 0, 14 mod 12 = 2, 28 mod 12 = 4, ...; those without E come last, as they came.
  const rising = [0, 2, 4, 6, 8, 10].sort((a, b) => ((a * 7) % 12) - ((b * 7) % 12));
  const without = [1, 3, 5, 7, 9, 11];
  assert.deepEqual(await first(), [...rising, ...without].map((i) => `s-${i}`));
  await on.keyboard.press("Enter");
  assert.equal(await heading.getAttribute("aria-sort"), "descending");
  assert.deepEqual(await first(), [...rising.reverse(), ...without].map((i) => `s-${i}`));
  await table.getByRole("searchbox").fill("second TOUGH");
  assert.deepEqual(await first(), ["s-5", "s-7", "s-9", "s-11"]);
  assert.match(await table.getByRole("status").innerText(), /4 of 12/);
  await photograph(on, "tables-sorted");
  const { bytes } = await savedFrom(on, table.getByRole("button", { name: /as CSV/ }));
  assert.deepEqual(bytes.toString().trim().split("\n").slice(1).map((line) => line.split(",")[0]), await first());
  await table.getByRole("searchbox").fill("nobody");
  await on.locator("text=No row contains “nobody”").waitFor();
  await table.getByRole("searchbox").fill("");
  await table.locator("th", { hasText: /^specimen/ }).getByRole("button").click();
  assert.deepEqual(await first(), rows.map((r) => r.specimen)); // s-2 before s-10
  assert.deepEqual(on.troubles, []);
  await leave(on);
});
