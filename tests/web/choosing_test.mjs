// Finding, sorting and choosing on the page of a game that waits for a person, and what is entered from there.

import assert from "node:assert/strict";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { browser, leave, photograph, savedFrom, visit, visitWith } from "./browser.mjs";
import { endAll, nacre, openDashboard, playGame, ROOT, until } from "./games.mjs";

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

const PUBLISHED = "577fffe9fffdef";
const read = async (path) => (await fetch(`${live.url}runs/game${path}`)).json();
const stateOf = async (design) =>
  (await read("/api/laboratory")).designs.find((d) => d.design === design)?.state ?? "unknown";

test("a box on the gamut fills a shortlist, which is approved on the page and by the command line", async () => {
  const on = await visit(`${live.url}#game`);
  const panel = on.getByRole("region", { name: "shortlist" });
  const listed = () => panel.locator("tbody tr").count();
  await on.locator(".brush summary").click();
  await on.locator(".brush .row [role=status]", { hasText: /^[1-9]\d* chosen/ }).waitFor();
  await on.getByRole("button", { name: "draw a box on the chart" }).click();
  await on.locator(".brush-box").scrollIntoViewIfNeeded();
  const chart = await on.locator(".brush-box").boundingBox();
  await on.mouse.move(chart.x + 60, chart.y + 16);
  await on.mouse.down();
  await on.mouse.move(chart.x + chart.width * 0.7, chart.y + chart.height - 50, { steps: 4 });
  await on.mouse.up();
  const bounds = {};
  for (const name of ["E at least, GPa", "E at most, GPa", "T at least, MPa", "T at most, MPa"])
    bounds[name] = Number(await on.getByLabel(name).inputValue());
  assert.ok(bounds["E at most, GPa"] > bounds["E at least, GPa"], JSON.stringify(bounds));
  assert.ok(bounds["T at most, MPa"] > bounds["T at least, MPa"], JSON.stringify(bounds));
  await on.getByLabel("among").selectOption("all");
  await on.getByLabel("rigid share at least, %").fill("55");
  await on.getByLabel("printed").selectOption("not printed");
  await photograph(on, "shortlist-brushed");
  await on.getByRole("button", { name: /^Add [1-9]\d* to the shortlist/ }).click();
  const count = await listed();
  assert.ok(count > 0);
  const { name, bytes } = await savedFrom(on, panel.getByRole("button", { name: "Shortlist as CSV" }));
  assert.equal(name, "game-shortlist.csv");
  const rows = bytes.toString().trim().split("\n").map((line) => line.split(","));
  assert.deepEqual(rows[0].slice(0, 4), ["design", "modulus_pa", "toughness_pa", "rigid_fraction"]);
  assert.equal(rows.length, count + 1);
  for (const [, e, t, rigid] of rows.slice(1)) {
    assert.ok(e >= bounds["E at least, GPa"] * 1e9 && e <= bounds["E at most, GPa"] * 1e9, `E ${e}`);
    assert.ok(t >= bounds["T at least, MPa"] * 1e6 && t <= bounds["T at most, MPa"] * 1e6, `T ${t}`);
    assert.ok(rigid >= 0.55, `rigid share ${rigid}`);
  }
  const [design, , , rigid] = rows.at(-1);
  assert.equal(Number(rigid), (await read(`/api/design?design=${design}`)).rigid_fraction);
  await on.reload();
  await until(async () => (await listed()) === count, 20, "the shortlist outlives a reload");
  await panel.getByRole("button", { name: "empty the list" }).click();
  assert.equal(await listed(), 0);

  const [proposed] = (await read("/api/laboratory")).proposal.designs.map((d) => d.design);
  const own = rows.slice(1).map(([design]) => design).filter((design) => design !== proposed);
  assert.ok(own.length > 2, "the box holds designs that nobody proposed");
  for (const design of [proposed, own[0]]) {
    await on.goto(`${live.url}#/run/game/game/design/${design}`);
    await on.getByRole("button", { name: "onto the shortlist" }).click();
    await on.getByRole("button", { name: "off the shortlist" }).waitFor();
  }
  assert.equal(await listed(), 2);
  await panel.getByLabel("Why").fill("worth a look");
  await panel.getByRole("button", { name: "Approve all 2" }).click();
  await panel.locator(".notice.good", { hasText: "2 designs will be measured." }).waitFor();
  assert.equal(await listed(), 0);
  await until(async () => (await stateOf(proposed)) !== "pending", 20, "the proposal counts");

  const file = join(game.folder, "..", "shortlist.csv");
  writeFileSync(file, `E,design\n1,${own[1]}\n2,${own[2]}\n2,${own[2]}\n`);
  const said = nacre("approve", "--run", game.folder, "--shortlist", file, "--by", "Ada");
  assert.match(said, new RegExp(`^${own[1]} added.*\n${own[2]} added.*\n$`));
  writeFileSync(file, "pattern\n" + own[1]);
  assert.throws(() => nacre("approve", "--run", game.folder, "--shortlist", file), /shortlist.csv:1: expected a shortlist/);
  writeFileSync(file, "design\nsoft\nnonsense\n");
  assert.throws(() => nacre("approve", "--run", game.folder, "--shortlist", file), /shortlist.csv:3: design: /);
  assert.deepEqual(on.troubles, []);
  await leave(on);
});

test("a design that one has found is ordered where it is shown", async () => {
  const on = await visit(`${live.url}#/run/game/explorer/design/${PUBLISHED}`);
  await on.getByRole("button", { name: "Have it measured" }).click();
  await on.locator(".measure").getByLabel("Why").fill("published");
  await on.getByRole("button", { name: "Order it" }).click();
  await on.locator(".notice.good", { hasText: `${PUBLISHED} will be measured` }).waitFor();
  assert.deepEqual(on.troubles, []);
  await leave(on);
});

/** A PNG of pixels (20 lines of 0 and 1), `size` points each, in two colours. */
const pictureOf = async (on, lines, size, colours = ["#101010", "#f0f0f0"], spot = null) =>
  Buffer.from(
    await on.evaluate(
      async ({ lines, size, colours, spot }) => {
        const canvas = new OffscreenCanvas(20 * size, 20 * size);
        const context = canvas.getContext("2d");
        lines.forEach((line, row) =>
          [...line].forEach((letter, column) => {
            context.fillStyle = colours[letter];
            context.fillRect(column * size, row * size, size, size);
          }),
        );
        if (spot) (context.fillStyle = spot), context.fillRect(0, 0, 1, 1);
        const blob = await canvas.convertToBlob({ type: "image/png" });
        return [...new Uint8Array(await blob.arrayBuffer())];
      },
      { lines, size, colours, spot },
    ),
  );

test("a pattern is drawn, read from files, checked at once and broken on request", async () => {
  const on = await visit(`${live.url}#/run/game/editor/design/${PUBLISHED}`);
  const pixels = on.locator(".pixel-editor");
  const drawn = () => pixels.getAttribute("data-design");
  await on.locator("text=/^E [\\d.]+ GPa, rigid share 84/").waitFor();
  await on.locator("text=Within the design space").waitFor();
  await pixels.focus();
  for (const key of ["ArrowRight", "Enter"]) await on.keyboard.press(key);
  assert.equal(await drawn(), "577fffe9fffdee"); // the corner, bit 0
  await on.locator(".violations", { hasText: "within 4 pixels of a corner must be rigid" }).waitFor();
  assert.match(on.url(), /editor\/design\/577fffe9fffdee$/);
  await on.getByRole("button", { name: "undo" }).click();
  assert.equal(await drawn(), PUBLISHED);
  await on.getByRole("button", { name: "exchange materials" }).click();
  await on.locator(".violations li", { hasText: "fewer than the 50 % required" }).waitFor();
  const box = await pixels.boundingBox();
  const at = (row, column) => [box.x + ((column + 0.5) * box.width) / 20, box.y + ((row + 0.5) * box.height) / 20];
  const before = BigInt(`0x${await drawn()}`);
  await on.mouse.move(...at(19, 10)); // an image of row 0, column 9: bit 9
  await on.mouse.down();
  await on.mouse.move(...at(19, 11)); // bit 8
  await on.mouse.up();
  const [nine, eight] = [(before >> 9n) & 1n, 1n - ((before >> 9n) & 1n)];
  const after = BigInt(`0x${await drawn()}`);
  assert.equal((after >> 9n) & 1n, 1n - nine);
  assert.equal((after >> 8n) & 1n, eight);
  assert.equal(after & ~0x300n, before & ~0x300n);

  const lines = readFileSync(join(ROOT, "data/patterns/published_a.txt"), "utf8").trim().split("\n");
  const upload = (name, buffer, mimeType = "image/png") =>
    on.locator('.editor input[type="file"]').setInputFiles({ name, mimeType, buffer });
  const refused = (why) => on.locator(".notice.bad", { hasText: why }).waitFor();
  await upload("a.png", await pictureOf(on, lines, 7));
  await on.locator(".notice.good", { hasText: "a.png is shown" }).waitFor();
  const key = await drawn();
  await upload("b.txt", Buffer.from(PUBLISHED), "text/plain");
  await until(async () => (await drawn()) === PUBLISHED, 10, "a key is taken");
  await upload("c.txt", Buffer.from(`${lines.join("\r\n")}\r\n\r\n`), "text/plain");
  await until(async () => (await drawn()) === key, 10, "picture and text are the same pattern");
  const skewed = [`${lines[0].slice(0, 5)}${lines[0][5] === "1" ? "0" : "1"}${lines[0].slice(6)}`, ...lines.slice(1)];
  await upload("d.png", await pictureOf(on, skewed, 1));
  await refused(/d.png: It lacks the eightfold symmetry: row 1, column \d+ is (rigid|soft), its mirror image/);
  await upload("e.png", await pictureOf(on, lines, 3, ["#000000", "#ffffff"], "#ff0000"));
  await refused("Pixel row 1, column 1 has several colours");
  await upload("f.png", await pictureOf(on, lines, 3, ["#777777", "#777777"]));
  await refused("It has one colour, expected two");
  await upload("g.txt", Buffer.from("0101\n"), "text/plain");
  await refused("It has 1 lines, expected 20");
  await upload("h.png", Buffer.from("no picture"));
  await refused("neither a picture");
  assert.equal(await drawn(), key);

  await on.getByRole("button", { name: "Break it" }).click();
  await on.locator(".film canvas").waitFor({ timeout: 60_000 });
  await on.getByRole("button", { name: "Have it measured" }).waitFor();
  await photograph(on, "editor", true);
  assert.deepEqual(on.troubles, []);
  await leave(on);
});

const UNORDERED = "3ffc9b4ad4d2d9";

test("a specimen is looked at before it is judged, and its story is on one page with photos", async () => {
  const curve = (factor) => `strain,stress_pa\n0,0\n0.01,${factor}e7\n0.02,${1.8 * factor}e7\n0.03,9e6\n0.035,0\n`;
  for (const [specimen, factor] of [["story-1", 1], ["story-2", 1.1]]) {
    const body = { specimen, pattern: UNORDERED, test: "toughness", note: "from grips.csv", curve_csv: curve(factor) };
    const headers = { "Content-Type": "application/json", "X-Nacre": "1" };
    const sent = await fetch(`${live.url}runs/game/api/measurement`, { method: "POST", headers, body: JSON.stringify(body) });
    assert.equal(sent.status, 200, await sent.text());
  }
  await until(async () => (await read(`/api/design?design=${UNORDERED}`)).specimens.length === 2, 30, "both are stored");
  const on = await visit(`${live.url}#laboratory`);
  const row = on.locator("tr", { hasText: "story-1" });
  await row.waitFor();
  await on.getByRole("button", { name: "review story-1" }).click();
  await on.getByRole("img", { name: "Curve of story-1 among its 1 replicates" }).waitFor();
  await photograph(on, "review-with-curve");
  await row.first().locator("input").fill("the grip slipped");
  await row.first().getByRole("button", { name: "not valid" }).click();
  await row.first().locator(".chip.rejected", { hasText: "not valid" }).waitFor();

  await on.goto(`${live.url}#/run/game/laboratory/specimen/story-1`);
  const decisions = on.locator(".table", { hasText: "Decisions" });
  await decisions.locator("td", { hasText: "the grip slipped" }).waitFor();
  const measured = on.locator(".table", { hasText: "As it was entered" });
  assert.match(await measured.innerText(), /from grips\.csv/);
  assert.match(await measured.locator("tbody tr").innerText(), /none\s+0\.\d+ MPa\s+5/);
  await on.getByRole("img", { name: /Curve of story-1/ }).waitFor();
  await on.locator(".notes summary").click();
  await on.getByLabel("note on specimen story-1").fill("cracked\nin the grip");
  await on.locator('.notes input[type="file"]').setInputFiles({
    name: "photo.png",
    mimeType: "image/png",
    buffer: await pictureOf(on, Array(20).fill("01".repeat(10)), 150), // 3000 points: made smaller
  });
  await on.locator("text=photo.png goes with it").waitFor();
  await on.getByRole("button", { name: "Keep the note" }).click();
  const photo = on.locator(".notes img");
  await photo.waitFor();
  await until(() => photo.evaluate((img) => img.complete && img.naturalWidth === 2000), 20, "the photo is shown");
  assert.match(await on.locator(".notes li").innerText(), /cracked\s+in the grip\s+web test, 20\d\d-/);
  const files = readdirSync(join(game.folder, "notes")).map((file) => file.replace(/^\d{8}T\d{6}Z-|-[0-9a-f]{8}\./g, "|"));
  assert.deepEqual(files.sort(), ["|specimen-story-1|jpg", "|specimen-story-1|json"]);
  assert.match(await measured.locator("tbody tr").innerText(), /^as first entered/);
  await on.getByLabel("note on specimen story-1").fill("not of this one");
  await on.getByRole("button", { name: "Keep the note" }).click();
  const second = on.locator(".notes li", { hasText: "not of this one" });
  await second.getByRole("button", { name: "remove …" }).click();
  await second.getByRole("button", { name: "remove it for good" }).click();
  await until(async () => (await on.locator(".notes li").count()) === 1, 20, "the second note is removed");
  await on.locator('.notes input[type="file"]').setInputFiles({ name: "x.png", mimeType: "image/png", buffer: Buffer.from("<svg/>") });
  await on.locator(".notice.bad", { hasText: "x.png is no picture" }).waitFor();
  await photograph(on, "specimen-story", true);
  assert.deepEqual(on.troubles, []);
  await leave(on);
});

test("a phone shows the editor, the shortlist and a specimen's story without scrolling sideways", async () => {
  const phone = await visit(live.url, { width: 375, height: 740, touch: true, dark: true });
  const views = [`editor/design/${PUBLISHED}`, `game/design/${PUBLISHED}`, "laboratory/specimen/story-1"];
  for (const [i, view] of views.entries()) {
    await phone.goto(`${live.url}#/run/game/${view}`);
    await phone.locator(".panel").first().waitFor();
    if (view.startsWith("game")) await phone.locator(".brush summary").click();
    await phone.waitForTimeout(800);
    assert.ok((await phone.evaluate(() => document.documentElement.scrollWidth)) <= 375, `${view} is wider than the phone`);
    await photograph(phone, `phone-choosing-${i}`, true);
  }
  assert.deepEqual(phone.troubles, []);
  await leave(phone);
});
