// The dashboard of a game that is played while it is watched, and of the same game once it is over.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { request } from "node:http";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { browser, drop, leave, photograph, savedFrom as download, visit, visitWith } from "./browser.mjs";
import { laboratoryFiles } from "./exports.mjs";
import { endAll, openDashboard, playGame, renamed, ROOT, until, withManyPatterns } from "./games.mjs";

const game = await playGame(join(ROOT, "tests/web/live.toml"), "game");
const live = await openDashboard(game.folder);
const page = await visit(live.url);
after(async () => {
  await browser.close();
  endAll();
});

const PUBLISHED = "577fffe9fffdef";
const CURVE = "strain,stress_pa\n0,0\n0.01,1e7\n0.02,1.8e7\n0.03,9e6\n0.035,0\n";

const view = (on, name) => on.locator(`nav a[href$="/${name}"]`).click();
const pointedAt = (on) => on.locator(".catcher").getAttribute("data-pointed");
/** Presses an arrow key until a point has come that it can point at; its design. */
const pointWithKeys = (on) =>
  until(async () => (await on.keyboard.press("ArrowRight"), pointedAt(on)), 20, "a point is pointed at");
const ringAt = async (on) => {
  const box = await on.locator(".ring:not(.chosen)").boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
};
const frameOf = (on) => on.locator(".film canvas").getAttribute("data-frame").then(Number);
/** How much of a canvas is painted, and in how many colours. A copy is read: Chromium warns of a canvas read twice. */
const painted = (on, selector) =>
  on.locator(selector).evaluate((canvas) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const points = new Uint32Array(copy.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    return { share: points.filter((p) => p !== 0).length / points.length, colours: new Set(points).size };
  });

test("a live game is shown and followed", async () => {
  await page.locator(".nodes li").nth(4).waitFor();
  assert.match(await page.locator(".standing").innerText(), /^(preparing )?round \d of 1: /);
  await page.locator(".units .unit-button").first().waitFor({ timeout: 60_000 });
  await photograph(page, "game-live");
  await view(page, "nodes");
  await page.locator("td", { hasText: "validation agent" }).first().waitFor();
  for (const table of ["Nodes", "Messages"]) {
    const region = page.getByRole("region", { name: table, exact: true });
    assert.equal(await region.locator("tbody tr").count(), 5);
    assert.ok(await region.evaluate((on) => on.scrollWidth <= on.clientWidth), `${table} fits the window`);
  }
  await photograph(page, "nodes");
  await view(page, "game");
});

test("the laboratory's round has its price before anything is approved", async () => {
  const other = await visitWith(`${live.url}#laboratory`, { "/api/run": (run) => ({ ...run, virtual_lab: false }) });
  const price = await other.locator(".price").innerText();
  // Nine designs in two tests, twice: nine pairs of notched specimens and 18 bars side by side, 945 mm of 250 a tray.
  const words = "36 specimens on 4 trays, 404 slices, about 4\\.5 h of printing, 6\\.0 h of testing, \\d+ ml of resin";
  assert.match(price, new RegExp(`^Round 1(, as expected)?: ${words}[;.]`));
  await photograph(other, "price");
  await leave(other);
});

test("a point is clicked and its film plays", async () => {
  await page.locator(".catcher").focus();
  await pointWithKeys(page);
  const [x, y] = await ringAt(page);
  await page.mouse.move(5, 5);
  await page.mouse.move(x, y);
  await page.locator(".card-tip").waitFor();
  await page.mouse.click(x, y);
  await page.locator(".film canvas").waitFor({ timeout: 40_000 });
  const first = await frameOf(page);
  await until(async () => (await frameOf(page)) > first + 5, 20, "the film goes on");
  await until(async () => (await painted(page, ".film canvas")).colours > 20, 20, "strains are told apart");
  assert.match(await page.getByLabel("colours of the film").innerText(), /soft\s+rigid\s+interface\s+breaking/);
  assert.equal(await page.locator(".design .chart").count(), 1);
  await photograph(page, "game-film");
});

test("a pattern without a film is simulated, and that is said", async () => {
  await page.locator(".toggle", { hasText: "proposals" }).click();
  await page.locator(".catcher").focus();
  for (const key of ["ArrowRight", "ArrowRight", "Enter"]) await page.keyboard.press(key);
  await page.locator(".design", { hasText: /simulated just now|being simulated|waiting for another/i }).waitFor();
  await page.locator(".film canvas").waitFor({ timeout: 40_000 });
  await page.locator(".toggle", { hasText: "proposals" }).click();
});

test("a measurement is entered and reviewed", async () => {
  await view(page, "laboratory");
  await page.locator('input[name="specimen"]').fill("by-hand-1");
  await page.locator('input[name="pattern"]').fill(PUBLISHED);
  await page
    .locator('.measurement input[type="file"]')
    .setInputFiles({ name: "curve.csv", mimeType: "text/csv", buffer: Buffer.from(CURVE) });
  await page.locator("text=curve.csv, 5 rows").waitFor();
  await photograph(page, "laboratory", true);
  await page.getByRole("button", { name: "Add measurement" }).click();
  await page.locator(".notice.good", { hasText: "by-hand-1 was added to the run" }).waitFor();
  const row = page.locator("tr", { hasText: "by-hand-1" });
  await row.locator(".chip", { hasText: /^valid$/ }).waitFor();
  await page.getByRole("button", { name: "review by-hand-1" }).click();
  await row.locator("input").fill("the grip slipped");
  await row.getByRole("button", { name: "not valid" }).click();
  await row.locator(".chip.rejected", { hasText: "not valid" }).waitFor();
  assert.match(await row.innerText(), /the grip slipped/);
});

test("what was mistyped is amended, what cannot be made is withdrawn, and the round closes", async () => {
  const person = await playGame(join(ROOT, "tests/web/person.toml"), "person");
  const its = await openDashboard(person.folder);
  const on = await visit(`${its.url}#laboratory`);
  on.setDefaultTimeout(60_000); // the search comes first
  const card = on.locator(".card");
  await card.getByRole("button", { name: "Approve", exact: true }).click();
  await card.locator(".chip", { hasText: "approved" }).waitFor();
  const design = await card.locator("code.key").innerText();
  assert.ok(await card.getByRole("button", { name: "Withdraw" }).isDisabled(), "a reason is asked for");
  await on.getByPlaceholder("kept with what you decide").fill("cannot be printed");
  await card.getByRole("button", { name: "Withdraw" }).click();
  await card.locator(".chip.withdrawn").waitFor();
  assert.match(await card.innerText(), /web test: cannot be printed/);
  await card.getByRole("button", { name: "Undo the withdrawal" }).click();
  await card.locator(".chip", { hasText: "approved" }).waitFor();
  await on.getByPlaceholder("kept with what you decide").fill("islands");
  await card.getByRole("button", { name: "Withdraw" }).click();
  await card.locator(".chip.withdrawn").waitFor();

  const orders = on.getByRole("region", { name: "Open orders" });
  await on.getByRole("button", { name: "withdraw r1/soft/toughness" }).click();
  await on.getByLabel("why r1/soft/toughness is withdrawn").fill("the notch tears");
  await photograph(on, "orders", true);
  await orders.getByRole("button", { name: "withdraw", exact: true }).click();
  await orders.locator("tr", { hasText: "web test: the notch tears" }).locator(".chip.rejected").waitFor();

  const measured = async (pattern, test, value) => {
    await on.locator('input[name="specimen"]').fill(`${pattern}-${test}`);
    await on.locator('input[name="pattern"]').fill(pattern);
    await on.locator('select[name="test"]').selectOption(test);
    await on.locator('input[name="value"]').fill(value);
    await on.getByRole("button", { name: "Add measurement" }).click();
    await on.locator(".notice", { hasText: `${pattern}-${test} was added to the run` }).waitFor();
  };
  await measured("soft", "modulus", "0,01"); // of 0.001
  await on.getByRole("button", { name: "amend soft-modulus" }).click();
  const form = on.getByRole("form", { name: "amend soft-modulus" });
  assert.equal(await form.locator('input[name="value"]').inputValue(), "0.01");
  await form.locator('input[name="value"]').fill("0.001");
  await form.locator('input[name="why"]').fill("decimal point");
  await photograph(on, "amendment", true);
  await form.getByRole("button", { name: "Amend" }).click();
  const row = on.locator("tr", { hasText: "soft-modulus" });
  await on.locator(".notice.good", { hasText: "soft-modulus is amended." }).waitFor();
  assert.match(await row.innerText(), /amended by web test: decimal point \(it was E 0\.010* GPa\)/);
  for (const [pattern, test, value] of [
    ["interface", "modulus", "0.56"],
    ["interface", "toughness", "0.9"],
    ["rigid", "modulus", "2.7"],
    ["rigid", "toughness", "0.2"],
  ])
    await measured(pattern, test, value);
  await until(() => person.said.includes("the game is over"), 120, `the round closes without ${design}; ${person.said}`);
  const { specimens } = await (await on.request.get(`${its.url}api/laboratory`)).json();
  assert.equal(specimens.find((s) => s.specimen === "soft-modulus").modulus_pa, 1e6);
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await its.close();
});

const SERIES = "tests/unit/measurement/data/exports/clean/testxpert_series.csv";
const understood = (on) => on.getByRole("region", { name: "what is understood of the files" });

/** Specimens of the run as the server lists them, by name. */
const measured = async (url) => {
  const { specimens } = await (await fetch(`${url}api/laboratory`)).json();
  return new Map(specimens.map((s) => [s.specimen, s]));
};

test("32 specimens of three makers are dropped, corrected and handed in with at most twelve clicks", async () => {
  const own = await playGame(join(ROOT, "tests/web/live.toml"), "import");
  const dashboard = await openDashboard(own.folder);
  const on = await visit(dashboard.url);
  await on.addInitScript(() =>
    addEventListener("click", (e) => {
      if (e.isTrusted) sessionStorage.clicks = Number(sessionStorage.clicks ?? 0) + 1;
    }, true));
  await on.goto(`${dashboard.url}#laboratory`);
  await on.reload();
  await on.locator("input[name=specimen]").fill("typed before the reload"); // the game plays
  const { specimens, sheet, files } = laboratoryFiles(32);
  const typed = "m-05.dat,m-05,577fffe9fffdef,toughness,52,3.2,";
  assert.ok(sheet.text.includes(typed));
  sheet.text = sheet.text.replace(typed, typed.replace("3.2", "0.32"));
  files[3].text = files[3].text.replaceAll("(N)", "").replaceAll("(mm)", "");
  await drop(on, [sheet, ...files]);
  const rows = understood(on).locator("tbody tr");
  await until(async () => (await rows.count()) === 32, 40, "all rows of the sheet are shown");
  const first = await rows.first().innerText();
  assert.match(first, /m-01[\s\S]*0\.8000[\s\S]*0\.0\d+/, "E is that of the file");
  assert.equal(await rows.first().locator("polyline").count(), 1);
  const questions = on.getByRole("list", { name: "questions before specimens count" }).getByRole("listitem");
  await questions.first().waitFor();
  await photograph(on, "import", true);

  // The thickness of m-05 was typed in cm: its cell is corrected in place, and stays so after a reload.
  const cellOf = (column) => understood(on).locator(".cells label", { hasText: new RegExp(`^${column}$`) }).locator("input");
  await understood(on).getByRole("button", { name: "m-05" }).click();
  assert.equal(await cellOf("thickness_mm").inputValue(), "0.32");
  await cellOf("thickness_mm").fill("3.2");
  await on.reload();
  await until(async () => (await rows.count()) === 32, 40, "the files are still there after a reload");
  assert.equal(await on.locator("input[name=specimen]").inputValue(), "typed before the reload");
  await understood(on).getByRole("button", { name: "m-05" }).click();
  assert.equal(await cellOf("thickness_mm").inputValue(), "3.2");
  assert.match(await rows.nth(4).innerText(), /0\.84/);

  // Nothing counts before what is asked is answered.
  const handIn = on.getByRole("button", { name: /^Hand in \d+ specimens?$/ });
  assert.equal(await questions.count(), 2, "the units of m-04, the thickness of m-07");
  assert.equal(await handIn.innerText(), "Hand in 30 specimens");
  const units = questions.filter({ hasText: /no unit that is read/ });
  assert.match(await units.innerText(), /m-04\.csv[\s\S]*expected the unit/);
  await units.getByLabel("what stands there").fill("mm N");
  await units.getByRole("button", { name: "correct it" }).click();
  await until(async () => (await questions.count()) === 1, 40, "m-04 is read");
  await questions.filter({ hasText: /52 x 1.5 mm/ }).getByRole("button", { name: "It is right" }).click();
  await until(async () => (await handIn.innerText()) === "Hand in 32 specimens", 20, "all are ready");
  await handIn.click();
  await on.locator(".import .notice.good", { hasText: "32 specimens are in the run." }).waitFor({ timeout: 60_000 });
  const clicks = Number(await on.evaluate(() => sessionStorage.clicks));
  console.log(`32 specimens, ${clicks} clicks`);
  assert.ok(clicks >= 4 && clicks <= 12, `${clicks} clicks`);

  const held = await measured(dashboard.url);
  for (const { name, design, peak_pa, modulus_pa } of specimens) {
    const specimen = held.get(name);
    assert.equal(specimen?.design, design, name);
    const triangle_pa = peak_pa ** 2 / modulus_pa; // area under the straight rise and fall
    assert.ok(Math.abs(specimen.toughness_pa / triangle_pa - 1) < 0.05, `${name}: T ${specimen.toughness_pa}`);
  }
  const sets = execFileSync("find", [join(own.folder, "laboratory/imports"), "-name", "provenance.csv"], { encoding: "utf8" });
  assert.equal(sets.trim().split("\n").length, 1, "the files and where each number came from are kept with the run");
  await until(async () => (await rows.count()) === 0, 20, "the draft has done its work");

  // The same again changes nothing.
  sheet.text = laboratoryFiles(32).sheet.text;
  await drop(on, [sheet, ...laboratoryFiles(32).files]);
  await questions.first().getByRole("button", { name: "It is right" }).click();
  await until(async () => (await handIn.innerText()) === "Hand in 32 specimens", 40, "they are read again");
  await handIn.click();
  await on.locator(".import .notice.good", { hasText: "32 specimens are in the run." }).waitFor({ timeout: 60_000 });
  const again = await measured(dashboard.url); // the laboratory of the game goes on measuring others meanwhile
  for (const { name } of specimens) assert.deepEqual(again.get(name), held.get(name), name);
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await dashboard.close();
  own.child.kill("SIGINT");
  await own.ended;
});

test("files without a sheet get one from the open orders, and what cannot be read says where", async () => {
  const order = {
    round: 1, design: PUBLISHED, test: "toughness", orientation_deg: 0, strain_rate_per_s: 6.17e-4, thickness_mm: 3.2,
    width_mm: 52, gauge_mm: 54, standard: true, loading: "monotonic", batch: "b", replicates: 2, arrived: 0, valid: 0,
    complete: false, reason: "asked",
  };
  const other = await visitWith(`${live.url}#laboratory`, {
    "/api/laboratory": (work) => ({
      ...work,
      orders: [{ ...order, order: "o-1" }, { ...order, order: "o-2", design: "rigid" }],
      printed: [{ label: "b-07", design: "rigid", test: "toughness", orientation_deg: 0, order: "o-2" }],
    }),
  });
  const { files } = laboratoryFiles(3);
  const named = ["raw b-07.csv", "first.dat", "broken.csv"].map((name, i) => ({ name, text: files[i].text }));
  named[2].text = "no table at all\n";
  const series = { name: "series.csv", text: readFileSync(join(ROOT, SERIES), "latin1") };
  await drop(other, named);
  const rows = understood(other).locator("tbody tr");
  await until(async () => (await rows.count()) === 3, 40, "a row for each file");
  const textOf = (name) => rows.filter({ hasText: name }).first().innerText();
  assert.match(await textOf("raw b-07.csv"), /b-07[\s\S]*rigid/, "the label in the file's name tells the specimen");
  assert.match(await textOf("first.dat"), new RegExp(PUBLISHED));
  const asked = other.getByRole("list", { name: "questions before specimens count" });
  await asked.getByText("The page took this order").waitFor();
  await understood(other).getByRole("button", { name: "broken" }).click();
  assert.match(await understood(other).locator(".details .fault").innerText(), /broken\.csv.*expected/);
  await photograph(other, "import-without-sheet", true);
  await drop(other, [series]);
  await asked.getByRole("button", { name: "A row for each of the 2 tests" }).click();
  await until(async () => (await rows.filter({ hasText: "series.csv" }).count()) === 2, 40, "a row for each test");
  await rows.filter({ hasText: "series-2" }).locator("polyline").waitFor();
  const phone = await visit(`${live.url}#laboratory`, { width: 375, height: 740, touch: true });
  await drop(phone, [laboratoryFiles(3).sheet, ...files]);
  await until(async () => (await understood(phone).locator("polyline").count()) === 3, 40, "read on a phone");
  await understood(phone).getByRole("button", { name: "m-02" }).click();
  const table = await understood(phone).evaluate((on) => [on.scrollWidth, on.clientWidth]);
  assert.ok(table[0] <= table[1], `the table is wider than the phone: ${table}`);
  assert.ok((await phone.evaluate(() => document.documentElement.scrollWidth)) <= 375);
  await photograph(phone, "phone-import", true);
  await leave(phone);
  await leave(other);
});

test("every replicate of a turned order is entered as a turned one", async () => {
  const turned = { order: "turned", round: 1, design: PUBLISHED, test: "toughness", orientation_deg: 90 };
  const usual = { strain_rate_per_s: 0.00617, thickness_mm: 6.4, loading: "monotonic", batch: "b", replicates: 3 };
  const given = [];
  const other = await visitWith(`${live.url}#laboratory`, {
    "/api/laboratory": (work) => ({
      ...work,
      orders: [{ ...turned, ...usual, arrived: given.length, valid: given.length, complete: false, reason: "asked" }],
    }),
  });
  await other.route("**/api/measurement", (route) => {
    given.push(route.request().postDataJSON());
    return route.fulfill({ json: { answer: "accepted" } });
  });
  const file = other.locator('.measurement input[type="file"]');
  await other.locator('select[name="order"]').selectOption("turned");
  await other.locator('input[name="thickness"]').fill("6,4");
  await file.setInputFiles({ name: "curve.csv", mimeType: "text/csv", buffer: Buffer.from(CURVE) });
  await other.getByRole("button", { name: "Add measurement" }).click();
  await other.locator(".notice.good", { hasText: "was added to the run" }).waitFor();
  assert.equal(await file.inputValue(), "");
  assert.equal(await other.locator('select[name="orientation"]').inputValue(), "90");
  await other.locator('input[name="value"]').fill("0,17");
  await other.getByRole("button", { name: "Add measurement" }).click();
  await until(() => given.length === 2, 20, "the second replicate is handed in");
  const conditions = { orientation_deg: "90", strain_rate_per_s: 0.00617, thickness_mm: 6.4 };
  for (const each of given) assert.deepEqual({ ...each, ...conditions }, each);
  assert.deepEqual(
    given.map((each) => [each.specimen, each.curve_csv, each.toughness_pa]),
    [
      ["b-577fffe9-toughness-turned-1", CURVE, null],
      ["b-577fffe9-toughness-turned-2", "", 170000],
    ],
  );
  // What is typed outlives a look at another view; another test has another unit, and is not what the order asks for.
  await other.waitForFunction(() => document.querySelector('input[name="specimen"]').value.endsWith("-3"));
  await other.locator('input[name="value"]').fill("0,2");
  for (const view of ["Nodes", "Laboratory"]) await other.getByRole("link", { name: view }).click();
  assert.equal(await other.locator('input[name="value"]').inputValue(), "0,2");
  await other.locator('select[name="test"]').selectOption("modulus");
  for (const name of ["value", "specimen"]) assert.equal(await other.locator(`input[name="${name}"]`).inputValue(), "");
  assert.equal(await other.locator('select[name="order"]').inputValue(), "");
  assert.deepEqual(other.troubles, []);
  await leave(other);
});

test("a late refusal is shown with its reason, and what was typed stays", async () => {
  const why = "An APPROVAL changes nothing: it is ordered already. What the run has stays.";
  const refusal = { status: 409, json: { answer: "refused", error: why } };
  const of = { design: PUBLISHED, test: "modulus", orientation_deg: 0, batch: "", points: 0, by: "", why: "", note: "" };
  const proposed = { design: PUBLISHED, modulus_pa: 1e9, toughness_pa: 1e5, reason: "" };
  const other = await visitWith(`${live.url}#laboratory`, {
    "/api/laboratory": (work) => ({
      ...work,
      proposal: { round: 0, simulations: 1, designs: [proposed] },
      designs: [],
      specimens: [{ ...of, specimen: "late", modulus_pa: 1e9, toughness_pa: null, valid: true }],
    }),
  });
  for (const path of ["approval", "measurement", "review"])
    await other.route(`**/api/${path}`, (route) => route.fulfill(refusal));
  const said = (title) => other.locator(".panel", { hasText: title }).locator(".notice.bad", { hasText: why });
  await other.getByRole("button", { name: "Approve", exact: true }).click();
  await said("Proposals of round 0").waitFor();
  await other.getByPlaceholder("key of 14 hex digits").fill(PUBLISHED);
  await other.getByRole("button", { name: "Have it measured" }).click();
  await until(async () => (await other.getByPlaceholder("key of 14 hex digits").inputValue()) === PUBLISHED, 5, "it stays");
  await other.locator('input[name="specimen"]').fill("late");
  await other.locator('input[name="pattern"]').fill(PUBLISHED);
  await other.locator('input[name="value"]').fill("1");
  await other.getByRole("button", { name: "Add measurement" }).click();
  await said("Enter a measurement").waitFor();
  assert.equal(await other.locator('input[name="specimen"]').inputValue(), "late");
  await other.getByRole("button", { name: "review late" }).click();
  await other.locator("tr", { hasText: "late" }).locator("input").fill("slipped");
  await other.getByRole("button", { name: "not valid" }).click();
  await said("Review (1 specimens)").waitFor();
  assert.deepEqual(other.troubles.filter((t) => !/status of 409/.test(t)), []);
  await leave(other);
});

test("a game that asks for no approvals offers none", async () => {
  const reason = "near the best predicted toughness; nothing is measured yet; warning: a plain mixture is as tough";
  const proposed = { design: PUBLISHED, modulus_pa: 1e9, toughness_pa: 1e5, reason };
  const other = await visitWith(`${live.url}#laboratory`, {
    "/api/run": (run) => ({ ...run, approval: false }),
    "/api/laboratory": (work) => ({
      ...work,
      proposal: { round: 0, simulations: 1, designs: [proposed] },
      designs: [],
    }),
  });
  await other.locator("text=does not wait for approval").waitFor();
  await other.locator(".card p", { hasText: /^ ?Near the best predicted toughness; nothing is measured yet\.$/ }).waitFor();
  await other.locator(".card p.doubt", { hasText: "Warning: a plain mixture is as tough." }).waitFor();
  assert.equal(await other.getByRole("button", { name: /Approve|Reject/ }).count(), 0);
  await leave(other);
});

test("long names leave the remarks and the review's button in sight, and a review its author", async () => {
  const of = { design: `L${"c3".repeat(50)}`, test: "modulus", orientation_deg: 90, batch: "", points: 0 };
  const said = { modulus_pa: 1e9, toughness_pa: null, valid: true, note: "", by: "Ada", why: "it broke as it should" };
  const specimen = { ...of, ...said, specimen: "n".repeat(100) };
  const other = await visitWith(`${live.url}#laboratory`, {
    "/api/laboratory": (work) => ({ ...work, specimens: [specimen] }),
  });
  const row = other.locator("tr", { hasText: specimen.specimen });
  await row.waitFor();
  const box = await row.getByRole("button", { name: "review" }).boundingBox();
  assert.ok(box.x + box.width < 1360, `the button ends at ${box.x + box.width}`);
  assert.match(await row.innerText(), /Ada: it broke as it should/);
  assert.equal(await row.locator("code.key").getAttribute("title"), of.design);
  await leave(other);
});

test("what cannot be a measurement is refused with the field and what was typed", async () => {
  const other = await visit(`${live.url}#laboratory`);
  await other.locator('input[name="specimen"]').fill("nonsense");
  await other.locator('input[name="pattern"]').fill("mix:7");
  for (const typed of ["abc", "0,17 MPa", "1,234.5"]) {
    await other.locator('input[name="value"]').fill(typed);
    await other.getByRole("button", { name: "Add measurement" }).click();
    await other.locator(".notice.bad", { hasText: `Toughness: “${typed}” is not a number` }).waitFor();
    assert.equal(await other.locator('input[aria-invalid="true"]').getAttribute("name"), "value");
  }
  await other.locator('input[name="value"]').fill("1");
  await other.getByRole("button", { name: "Add measurement" }).click();
  await other.locator(".notice.bad", { hasText: "Pattern, “mix:7”: " }).waitFor();
  await other.locator('input[name="pattern"]').fill(PUBLISHED);
  await other.locator('input[name="thickness"]').fill("-2");
  await other.getByRole("button", { name: "Add measurement" }).click();
  await other.locator(".notice.bad", { hasText: "Thickness, “-2” mm: -2 is not positive" }).waitFor();
  await other.locator('input[name="thickness"]').fill("");
  await other.locator('select[name="test"]').selectOption("modulus");
  await other.locator('input[name="value"]').fill("4e-10");
  await other.getByRole("button", { name: "Add measurement" }).click();
  await other.locator(".notice.bad", { hasText: "Young's modulus, “4e-10” GPa: 0.4 Pa, expected" }).waitFor();
  await other.locator('input[name="value"]').fill("1");
  await other.route("**/api/measurement", (route) => route.fulfill({ status: 413, body: "" }));
  await other.getByRole("button", { name: "Add measurement" }).click();
  await other.locator(".notice.bad", { hasText: "too large" }).waitFor();
  assert.deepEqual(
    other.troubles.filter((t) => !/status of (400|413)/.test(t)),
    [],
  );
  await leave(other);
});

/** Approves everything that waits for it; the page leads there. */
const approveAll = async () => {
  const approve = page.getByRole("button", { name: "Approve", exact: true });
  await view(page, "game");
  await page.locator(".standing a", { hasText: /waits for you, \d designs? to approve/ }).click({ timeout: 120_000 });
  await approve.first().waitFor({ timeout: 120_000 });
  for (let left = await approve.count(); left > 0; --left) {
    await approve.first().click();
    await until(async () => (await approve.count()) < left, 20, "the approval is taken");
  }
};

test("designs are grouped by hand before the family stage", async () => {
  await approveAll();
  await view(page, "families");
  const keep = page.getByRole("button", { name: "Save this grouping" });
  await page.locator(".groups .member").first().waitFor({ timeout: 120_000 });
  assert.ok(await keep.isDisabled());
  await page.getByLabel("name of family 1").fill("not a name");
  await page.locator(".notice.bad", { hasText: "letters, digits" }).waitFor();
  assert.ok(await keep.isDisabled());
  await page.getByLabel("name of family 1").fill("12");
  await page.locator(".notice.bad", { hasText: "digits alone" }).waitFor();
  await page.getByLabel("name of family 1").fill("mine");
  await keep.click();
  // Who will use it depends on whether the family stage has begun meanwhile: games are not slowed for this page.
  await page.locator(".notice.good", { hasText: /Saved: (the family stage|nacre families --run \S+) will use it/ }).waitFor();
  assert.match(readFileSync(join(game.folder, "families/families.toml"), "utf8"), /name = "mine"/);
});

test("the family stage waits for a yes to its variants, and the game goes on to its end", async () => {
  await view(page, "laboratory");
  await page.locator("h2", { hasText: "Variants of the families" }).waitFor({ timeout: 120_000 });
  await approveAll();
  await page.locator(".standing", { hasText: "finished after round 1" }).waitFor({ timeout: 120_000 });
  assert.equal(await game.ended, 0, game.said);
  await page.getByRole("link", { name: "report" }).waitFor(); // there was none when the page was opened
  await page.locator("text=Proposed after the last round").waitFor();
  assert.equal(await page.getByRole("button", { name: "Approve", exact: true }).count(), 0);
  await view(page, "game");
  await page.locator("text=Measured patterns").waitFor();
  await until(
    async () => (await page.locator("table", { hasText: "specimens" }).locator("tbody tr").count()) > 3,
    20,
    "measured patterns are listed",
  );
  await view(page, "diagnosis");
  await page.locator(".verdict h2").waitFor();
  await photograph(page, "diagnosis", true);
});

test("what is pointed at stays while the gamut comes", async () => {
  const other = await visit(live.url);
  let letGamutCome;
  const mayCome = new Promise((resolve) => (letGamutCome = resolve));
  await other.route("**/api/gamut?*", (route) => mayCome.then(() => route.continue()));
  await other.reload();
  await other.locator(".catcher").focus();
  const pointed = await pointWithKeys(other);
  const shareOf = async () => (await painted(other, ".gamut canvas")).share;
  const bare = await shareOf();
  letGamutCome();
  await until(async () => (await shareOf()) > bare, 20, "the gamut is shown");
  await ringAt(other);
  assert.equal(await pointedAt(other), pointed);
  await leave(other);
});

test("a key that comes with the first frame finds the chart made", async () => {
  const other = await visit(`${live.url}#nodes`);
  await other.locator('nav a[href$="/nodes"][aria-current="page"]').waitFor();
  const said = await other.evaluate(
    () =>
      new Promise((resolve) => {
        addEventListener("error", (event) => resolve(event.message));
        new MutationObserver((_, watch) => {
          const catcher = document.querySelector(".catcher");
          if (!catcher) return;
          watch.disconnect();
          catcher.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
          resolve("no error");
        }).observe(document.body, { childList: true, subtree: true });
        location.hash = "#game";
      }),
  );
  assert.equal(said, "no error");
  await leave(other);
});

test("the page of a live game has no errors and asks nobody else", async () => {
  await photograph(page, "live-at-the-end", true);
  assert.deepEqual(page.troubles, []);
});

test("a finished run is the same page, in the dark", async () => {
  assert.equal(await live.close(), 0, live.said);
  await leave(page);
  const finished = await openDashboard(game.folder);
  const dark = await visit(finished.url, { dark: true });
  await dark.locator(".standing", { hasText: "finished" }).waitFor();
  assert.equal(await dark.evaluate(() => document.documentElement.dataset.theme), "dark");
  await dark.locator("table", { hasText: "specimens" }).locator("button.link").first().click();
  await dark.locator(".film canvas").waitFor({ timeout: 40_000 });
  await dark.waitForTimeout(600);
  await photograph(dark, "game-dark", true);
  await dark.getByRole("button", { name: "light colours" }).click();
  assert.equal(await dark.evaluate(() => document.documentElement.dataset.theme), "light");
  await dark.reload();
  await dark.locator(".standing").waitFor();
  assert.equal(await dark.evaluate(() => document.documentElement.dataset.theme), "light");
  assert.deepEqual(dark.troubles, []);
  await leave(dark);
  await finished.close();
});

test("the page says what another round is expected to bring, and its price", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visit(finished.url);
  const said = await on.locator(".next-round").innerText();
  const growth = "\\d[.\\d]* ± \\d[.\\d]*";
  const expected = `round 2 is expected to bring ${growth}, .* % of .* \\(90 %: .* to .*; by the errors of the fit\\)`;
  const price = "for \\d+ specimens on \\d trays?, \\d+ slices, about [.\\d]+ h of printing, [.\\d]+ h of testing, \\d+ ml";
  assert.match(said, new RegExp(`^Round 1 brought ${growth} GPa MPa of measured hypervolume; ${expected}, ${price} of resin\\.$`));
  await photograph(on, "next-round", true);
  await leave(on);
  await finished.close();
});

test("families show their variants and whether their models were worth it", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visit(`${finished.url}#families`);
  await on.locator(".unit-button").first().click();
  await on.locator(".film canvas").waitFor({ timeout: 40_000 });
  for (const table of [/^Prediction errors on the variants/, /^Fit errors on the seeds/, /^Seeds and chosen variants/])
    assert.ok((await on.locator(".table", { hasText: table }).locator("tbody tr").count()) > 0, String(table));
  assert.match(await on.locator(".table", { hasText: /on the variants/ }).innerText(), /over-fit|worse than the global/);
  await on.locator(".catcher").focus();
  assert.match(await pointWithKeys(on), /^[0-9a-f]{14}$/);
  assert.match((await savedFrom(on, on.getByLabel("families as CSV"))).toString(), /^family,what,pattern,[\s\S]*,simulated,[0-9a-f]{14},/);
  await photograph(on, "families", true);
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await finished.close();
});

test("a family's model that is worse than the global one is called so", async () => {
  const finished = await openDashboard(game.folder);
  const of = (mean) => ({ n_modulus: 1, modulus_mean: 0.1, n_toughness: 1, toughness_mean: mean });
  const errors = { seeds: { global: of(0.1), family: of(0.2) }, chosen: { global: of(0.1), family: of(0.3) } };
  const on = await visitWith(`${finished.url}#families`, {
    "/api/families": (said) => ({ ...said, stage: said.stage.map((f) => ({ ...f, errors, over_fits: [] })) }),
  });
  await on.locator("strong.bad", { hasText: "worse than the global model in T" }).waitFor();
  await on.locator(".notice.bad", { hasText: "worse than the global model in T on the variants" }).waitFor();
  await leave(on);
  await finished.close();
});

test("of a family none of whose variants was measured nothing is claimed", async () => {
  const finished = await openDashboard(game.folder);
  const both = (errors) => ({ global: errors, family: errors });
  const known = { n_modulus: 1, modulus_mean: 0.1, n_toughness: 1, toughness_mean: 0.1 };
  const unmeasured = (d) => (d.is_seed ? d : { ...d, measured: { modulus_pa: null, toughness_pa: null } });
  let chosen = null;
  const on = await visitWith(`${finished.url}#families`, {
    "/api/families": (said) => ({
      ...said,
      stage: said.stage.map((f) => ({
        ...f,
        designs: f.designs.map(unmeasured),
        errors: { seeds: both(known), chosen: both(chosen) },
        is_validated: true,
        over_fits: [],
      })),
    }),
  });
  const cell = (text) => on.locator(".table", { hasText: /on the variants/ }).locator("td", { hasText: text });
  await cell(/^not measured$/).first().waitFor();
  assert.equal(await cell("does not over-fit").count(), 0);
  chosen = { ...known, n_toughness: 0 };
  await on.reload();
  await cell("does not over-fit E; T not measured").first().waitFor();
  await leave(on);
  await finished.close();
});

test("a grouping that is not saved yet outlives another proposal", async () => {
  const finished = await openDashboard(game.folder);
  let name = "first";
  const on = await visitWith(`${finished.url}#families`, {
    "/api/live": (said) => ({ ...said, data: name }),
    "/api/families": (said) => ({
      ...said,
      grouping: { ...said.grouping, from: "proposal", families: said.grouping.families.map((f, i) => (i ? f : { ...f, name })) },
    }),
  });
  const shown = on.getByLabel("name of family 1");
  const showsUp = (text) => until(async () => (await shown.inputValue()) === text, 20, `family 1 is called ${text}`);
  await shown.waitFor();
  await showsUp("first");
  name = "second";
  await showsUp("second");
  await shown.fill("mine");
  name = "third";
  await on.locator(".notice", { hasText: "The proposal has changed since you began" }).waitFor();
  assert.equal(await shown.inputValue(), "mine");
  assert.ok(await on.getByRole("button", { name: "Save this grouping" }).isEnabled());
  await on.getByRole("button", { name: "use the new one" }).click();
  await showsUp("third");
  assert.equal(await on.locator(".notice", { hasText: "changed since" }).count(), 0);
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await finished.close();
});

test("why the server cannot respond is said in its words until it can", async () => {
  const finished = await openDashboard(game.folder);
  const views = { laboratory: "/api/laboratory", diagnosis: "/api/diagnosis?*", families: "/api/families", explorer: "/api/maps" };
  const isSaid = async ([name, path]) => {
    const on = await visit(finished.url);
    await on.route(`**${path}`, (route) => route.fulfill({ status: 500, json: { error: "run.db: the disk is full" } }));
    await view(on, name);
    await on.locator(".notice.bad", { hasText: "run.db: the disk is full" }).first().waitFor();
    assert.equal(await on.locator("text=/^reading/").count(), 0, name);
    await on.unroute(`**${path}`);
    await on.locator(".notice.bad").first().waitFor({ state: "detached" });
    await on.locator(".panel h2, .panel h3").first().waitFor();
    await leave(on);
  };
  await Promise.all(Object.entries(views).map(isSaid));
  await finished.close();
});

test("a verdict stands under its own round alone", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visitWith(`${finished.url}#diagnosis`, {
    "/api/rounds": (said) => ({ ...said, rounds: said.rounds.map((r) => ({ ...r, verdict: "named" })) }),
  });
  let answer;
  const mayAnswer = new Promise((resolve) => (answer = resolve));
  const refusal = { status: 500, json: { error: "run.db is being read" } };
  await on.route("**/api/diagnosis?round=0", (route) => mayAnswer.then(() => route.fulfill(refusal)));
  const verdict = on.locator(".verdict");
  await verdict.locator("h2").waitFor();
  await on.getByRole("button", { name: "round 0" }).click();
  await verdict.locator("text=reading").waitFor();
  assert.equal(await verdict.locator("h2").count(), 0);
  answer();
  await verdict.locator(".notice.bad", { hasText: "run.db is being read" }).waitFor();
  assert.equal(await verdict.locator("h2").count(), 0);
  await on.getByRole("button", { name: "round 1" }).click();
  await verdict.locator("h2").waitFor();
  assert.equal(await verdict.locator(".notice").count(), 0);
  await leave(on);
  await finished.close();
});

test("the report is linked once it is there", async () => {
  const finished = await openDashboard(game.folder);
  let [report, data, asked] = [false, "before", 0];
  const on = await visitWith(finished.url, {
    "/api/live": (said) => ({ ...said, data }),
    "/api/run": (run) => (++asked, { ...run, report }),
  });
  const link = on.getByRole("link", { name: "report" });
  await on.locator("text=Measured patterns").waitFor();
  assert.equal(await link.count(), 0);
  report = true;
  const before = asked;
  await on.waitForTimeout(2500);
  assert.equal(asked, before); // nothing is new in the run
  data = "after";
  await link.waitFor();
  await leave(on);
  await finished.close();
});

test("an open design follows the run's data, and its film goes on", async () => {
  const finished = await openDashboard(game.folder);
  let [modulus_pa, data] = [1.797e9, "before"];
  const pulled = { specimen: "a", round: 1, test: "modulus", orientation_deg: 0, batch: "", toughness_pa: null };
  const on = await visitWith(finished.url, {
    "/api/live": (said) => ({ ...said, data }),
    "/api/design?*": (said) => ({
      ...said,
      specimens: [{ ...pulled, modulus_pa, valid: true, note: "", standard: true, curve: null }],
    }),
  });
  await on.locator("table", { hasText: "specimens" }).locator("button.link").first().click();
  await on.locator(".film canvas").waitFor({ timeout: 40_000 });
  await on.locator(".facts tr", { hasText: /^measured mean\s*1\.80/ }).waitFor();
  await on.evaluate(() => {
    const body = document.querySelector(".panel.design");
    body.querySelector(".film canvas").dataset.seen = "yes";
    new MutationObserver(() => {
      if (/measured mean\s*–/.test(body.querySelector(".facts").innerText)) body.dataset.emptied = "yes";
    }).observe(body, { childList: true, characterData: true, subtree: true });
  });
  [modulus_pa, data] = [2.5e9, "after"];
  await on.locator(".facts tr", { hasText: /^measured mean\s*2\.50/ }).waitFor();
  assert.equal(await on.locator(".film canvas").getAttribute("data-seen"), "yes");
  assert.equal(await on.locator(".panel.design").getAttribute("data-emptied"), null);
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await finished.close();
});

test("a round that has just begun hides neither the newest proposals nor the newest model", async () => {
  const finished = await openDashboard(game.folder);
  const begun = { summary: null, gamut_count: 0, measured_front: [], benchmark: [], proposals: [], parameters: {}, verdict: null };
  const on = await visitWith(finished.url, {
    "/api/rounds": (said) => ({ ...said, rounds: [...said.rounds, { round: 2, ...begun }] }),
  });
  const modelAsked = async (act) => {
    const [asked] = await Promise.all([on.waitForRequest("**/api/simulation?*"), act()]);
    return new URL(asked.url()).searchParams.get("model");
  };
  await on.locator("h3", { hasText: "Newest proposals" }).waitFor();
  assert.equal(await modelAsked(() => on.locator(".unit-button").first().click()), "1");
  await on.locator(".design .eyebrow", { hasText: "proposed in round 1" }).waitFor();
  await on.locator(".catcher").focus();
  await pointWithKeys(on);
  assert.match(await on.locator(".card-tip").innerText(), /measured in round/);
  assert.equal(await modelAsked(() => on.keyboard.press("Enter")), "1");
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await finished.close();
});

test("a mean has the digits of its error, and only specimens of the usual conditions in it", async () => {
  const finished = await openDashboard(game.folder);
  const pulled = { specimen: "a", round: 1, orientation_deg: 0, batch: "", valid: true, note: "", curve: null };
  const specimen = (modulus_pa, standard) => ({ ...pulled, test: "modulus", modulus_pa, toughness_pa: null, standard });
  const on = await visitWith(finished.url, {
    "/api/rounds": (said) => ({
      ...said,
      rounds: said.rounds.map((r) => ({ ...r, summary: r.summary && { ...r.summary, gap: 0.2002 } })),
      measured: said.measured.map((m) => ({ ...m, modulus_pa: 1.797e9, modulus_sd_pa: 1.6e7 })),
    }),
    "/api/design?*": (said) => ({ ...said, specimens: [specimen(1.797e9, true), specimen(2.5e9, false)] }),
  });
  await on.locator("td", { hasText: /^0\.200$/ }).first().waitFor();
  await on.locator("td", { hasText: /^1\.797 ± 0\.016$/ }).first().waitFor();
  await on.locator("table", { hasText: "specimens" }).locator("button.link").first().click();
  await on.locator(".facts tr", { hasText: /^measured mean\s*1\.80/ }).waitFor();
  await leave(on);
  await finished.close();
});

test("soft and rigid have the same colours in icons and films, in both themes, and a legend", async () => {
  const finished = await openDashboard(game.folder);
  for (const dark of [false, true]) {
    const on = await visit(finished.url, { dark });
    await on.locator(".unit-button").first().click();
    await on.locator(".film canvas").waitFor({ timeout: 40_000 });
    const swatch = (legend, material) =>
      on.getByLabel(legend).locator("li", { hasText: material }).locator(".swatch").evaluate((e) => getComputedStyle(e).backgroundColor);
    const fill = (part) => on.locator(`.design-head .unit ${part}`).evaluate((e) => getComputedStyle(e).fill);
    for (const [material, part, colour] of [["soft", "rect", "rgb(34, 38, 44)"], ["rigid", "path", "rgb(141, 151, 166)"]]) {
      assert.equal(await fill(part), colour, `${material}, dark: ${dark}`);
      for (const legend of ["colours of the materials", "colours of the film"]) assert.equal(await swatch(legend, material), colour);
    }
    await leave(on);
  }
  await finished.close();
});

test("a film's T is told apart from means", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visit(finished.url);
  await on.locator(".unit-button").first().click();
  await on.locator(".film canvas").waitFor({ timeout: 40_000 });
  for (const name of [/^predicted mean/, /^this film/, /^measured mean/])
    assert.ok(await on.locator(".facts tr", { hasText: name }).locator("[title]").getAttribute("title"), String(name));
  await on.locator(".design p", { hasText: /^The film shows one specimen, T [\d.]+ MPa\./ }).waitFor();
  await leave(on);
  await finished.close();
});

test("headings have explanations, and no axis is empty without a sentence", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visitWith(finished.url, {
    "/api/rounds": (said) => ({ ...said, measured: [], rounds: said.rounds.slice(0, 1) }),
  });
  const headings = on.getByRole("region", { name: "Rounds" }).locator("th");
  await headings.first().waitFor();
  for (const heading of await headings.all()) assert.ok((await heading.getAttribute("title"))?.length > 10);
  const trends = on.locator(".trend .nothing", { hasText: "Known once proposed designs have been measured." });
  await trends.nth(1).waitFor();
  assert.equal(await on.locator(".gamut .nothing").count(), 0);
  for (const layer of await on.locator(".toggles fieldset").nth(1).locator(".toggle").all()) await layer.click();
  await on.locator(".gamut .nothing", { hasText: "Everything is switched off" }).waitFor();
  await on.locator(".toggles fieldset").first().locator(".toggle").click();
  await on.locator(".gamut .nothing", { hasText: "No round is shown" }).waitFor();
  await leave(on);
  await finished.close();
});

test("the page explains its words", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visit(finished.url);
  await on.getByRole("link", { name: "What do the words mean?" }).click();
  await on.locator(".glossary tr", { hasText: "Young's modulus" }).first().waitFor();
  const all = await on.locator(".glossary tr").count();
  await on.getByLabel("Find").fill("pareto");
  await until(async () => (await on.locator(".glossary tr").count()) < all, 20, "fewer words are shown");
  await on.locator(".glossary tr", { hasText: "Pareto front" }).first().waitFor();
  await on.getByLabel("Find").fill("no such word");
  await on.locator("text=No word contains").waitFor();
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await finished.close();
});

test("the explorer breaks what lies between patterns", async () => {
  const finished = await openDashboard(game.folder);
  const explorer = await visit(`${finished.url}#explorer`);
  const map = explorer.locator(".catcher.map");
  await map.waitFor({ timeout: 60_000 });
  const box = await map.boundingBox();
  const [x, y] = [box.x + 0.5 * box.width, box.y + 0.5 * box.height];
  await explorer.mouse.move(x - 60, y);
  await explorer.mouse.down();
  await explorer.mouse.move(x, y, { steps: 8 });
  await explorer.mouse.up();
  await until(async () => /^[0-9a-f]{14}$/.test(await map.getAttribute("data-blend")), 20, "a pattern between");
  await explorer.getByRole("button", { name: "Break it" }).click();
  await explorer.locator(".film canvas").waitFor({ timeout: 40_000 });
  await photograph(explorer, "explorer");
  await map.focus();
  const before = await map.getAttribute("data-blend");
  for (let i = 0; i < 12; ++i) await explorer.keyboard.press("ArrowRight");
  await until(async () => (await map.getAttribute("data-blend")) !== before, 20, "the keyboard moves on the map");
  const handleAt = async () => Number(await explorer.locator(".handle").getAttribute("cx"));
  for (let i = 0; i < 120; ++i) await explorer.keyboard.press("ArrowLeft");
  const edge = await handleAt();
  await explorer.keyboard.press("ArrowRight");
  await until(async () => (await handleAt()) > edge, 20, "a key leads back from the edge of the map");
  await explorer.locator(".toggle", { hasText: /^E$/ }).click();
  await explorer.locator(".panel-head select").selectOption("gamut/0");
  await explorer.locator("text=Nothing chosen yet").waitFor();
  await map.waitFor({ timeout: 60_000 });
  assert.equal(await map.getAttribute("data-blend"), "");
  await map.focus();
  await explorer.keyboard.press("ArrowRight");
  await until(async () => /^[0-9a-f]{14}$/.test(await map.getAttribute("data-blend")), 20, "the other map is gone about");
  // On the page the scale of colours stands among the buttons.
  const words = await textsOf(explorer, await savedFrom(explorer, explorer.getByLabel(/^map-.* as SVG$/)));
  assert.ok(words.some((w) => /^[ET] +[\d.]+$/.test(w)) && words.some((w) => /^[\d.]+ [GM]Pa$/.test(w)), words.join());
  assert.deepEqual(explorer.troubles, []);
  await leave(explorer);
  await finished.close();
});

test("every view, round, design and specimen has an address, which opens by itself", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visit(finished.url);
  await on.locator(".unit-button").first().click();
  await on.locator(".design .eyebrow", { hasText: "proposed in round 1" }).waitFor();
  assert.match(on.url(), /#\/run\/game\/game\/design\/[0-9a-f]{14}\/model\/1$/);
  const design = /design\/([0-9a-f]{14})/.exec(on.url())[1];
  const named = (title) => until(async () => (await on.title()) === title, 10, `the title ${title}`);
  await named(`${design} · Game · game · nacre`);
  await on.reload();
  await on.locator(".film canvas").waitFor({ timeout: 40_000 });
  await on.locator(".design .key", { hasText: design }).waitFor();

  await on.locator(".toggles fieldset").first().locator(".toggle", { hasText: "0" }).click();
  assert.match(on.url(), /\/game\/round\/0,1\/design\//);
  await on.goBack();
  await until(async () => !(await on.locator(".toggle", { hasText: "0" }).locator("input").isChecked()), 10, "round 0 is off");
  await view(on, "diagnosis");
  await on.locator(".verdict h2").waitFor();
  await on.getByRole("button", { name: "round 1" }).click();
  await named("round 1 · Diagnosis · game · nacre");
  await on.goBack();
  await named("Diagnosis · game · nacre");
  await on.goBack();
  await on.locator(".design .key", { hasText: design }).waitFor();
  await on.goForward();
  await on.locator(".verdict h2").waitFor();

  await view(on, "laboratory");
  await on.getByRole("link", { name: "by-hand-1" }).click();
  await on.locator('tr[aria-current="true"]', { hasText: "by-hand-1" }).waitFor();
  await on.reload();
  const row = on.locator('tr[aria-current="true"]', { hasText: "by-hand-1" });
  await row.waitFor();
  await until(async () => {
    const box = await row.boundingBox();
    return box.y > 0 && box.y < 900;
  }, 10, "the specimen is in sight");
  await named("by-hand-1 · Laboratory · game · nacre");
  await view(on, "families");
  await on.locator(".unit-button").first().click();
  await on.reload();
  await on.locator(".film canvas").waitFor({ timeout: 40_000 });
  assert.match(await on.locator(".design .eyebrow").innerText(), /variant|seed/);
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await finished.close();
});

test("an address without anything behind it says so, and leads on", async () => {
  const finished = await openDashboard(game.folder);
  const on = await visit(finished.url);
  const says = async (hash, sentence) => {
    await on.goto(`${finished.url}${hash}`);
    await on.locator(".wait, .notice", { hasText: sentence }).waitFor();
  };
  await says("#/run/other/game", "There is no run “other” on this page: it shows game.");
  await says("#/run/game/nonsense", "There is no view “nonsense”.");
  await says("#nonsense", "There is no view “nonsense”.");
  await says("#/nonsense", "There is nothing at this address.");
  await says("#/run/game/nodes/round/1", "The view “Nodes” shows no “round”.");
  await says("#/run/game/game/round/7", "There is no round 7 here: this run has rounds 0 to 1.");
  await says("#/run/game/game/round/x", "There is no round x here");
  await says("#/run/game/game/design/soap", "“soap” cannot be shown. design: ");
  await says("#/run/game/diagnosis/round/7", "Round 7 has no diagnosis");
  await says("#/run/game/laboratory/specimen/nobody%20there", "This run has no specimen “nobody there”.");
  await says("#/run/game/explorer/map/gamut%2F9", "This run has no map “gamut/9”.");
  await says("#/run/%E0%A4%A/game", "There is no run");
  await on.getByRole("link", { name: "Show what there is" }).click();
  await on.locator(".catcher").waitFor();
  assert.deepEqual(on.troubles.filter((t) => !/status of 400/.test(t)), []);
  await leave(on);
  await finished.close();
});

test("several runs are listed and compared, and one that cannot be read says why", async () => {
  const others = [renamed(game.folder, "second"), renamed(game.folder, "begun", true), join(game.folder, "films")];
  const several = await openDashboard([game.folder, ...others]);
  const on = await visit(several.url);
  const rows = on.getByRole("region", { name: "All runs" }).locator("tbody tr");
  await rows.nth(3).waitFor();
  const said = await rows.allInnerTexts();
  assert.match(said[0], /^game\s+web\s+tiny\s+finished\s+1 of 1\s+[\d.]+ ± [\d.]+\s+[\d.]+/);
  assert.match(said[2], /^begun\s+web\s+tiny\s+stopped\s+none of 1\s+–\s+–/);
  assert.match(said[3], /^films\s+–\s+–\s+cannot be read[\s\S]*manifest\.json/);
  await on.locator(".trends canvas").nth(2).waitFor();
  assert.equal(await on.title(), "Runs · nacre");
  assert.equal(await on.locator(".run-keys .toggle").count(), 3);
  for (const panel of [on.locator(".trend").first(), on.locator(".panel", { hasText: "Measured fronts" })])
    await panel.locator("text=begun has nothing to show here so far.").waitFor();
  const words = await textsOf(on, readFileSync(await (await Promise.all([on.waitForEvent("download"), on.getByLabel("fronts as SVG").click()]))[0].path()));
  for (const name of ["game", "second"]) assert.ok(words.includes(name), words.join());
  const csv = readFileSync(await (await Promise.all([on.waitForEvent("download"), on.getByLabel("gap as CSV").click()]))[0].path(), "utf8");
  assert.match(csv, /^round,gap_gpa_mpa_game,gap_gpa_mpa_second,gap_gpa_mpa_begun\n0,/);
  await photograph(on, "runs", true);
  for (const name of ["game", "second"]) await on.locator(".run-keys .toggle", { hasText: name }).click();
  await on.locator(".nothing", { hasText: "No run has measured a pattern in both tests yet." }).waitFor();
  await on.locator(".run-keys .toggle", { hasText: "begun" }).click();
  await on.locator("text=Every run is switched off").waitFor();

  await on.getByRole("link", { name: "second" }).click();
  await on.locator("h1", { hasText: "second" }).waitFor();
  await on.locator(".standing", { hasText: "finished after round 1" }).waitFor();
  const [asked] = await Promise.all([on.waitForRequest("**/api/laboratory"), view(on, "laboratory")]);
  assert.match(asked.url(), /\/runs\/second\/api\/laboratory$/);
  await on.getByRole("link", { name: "all 4 runs" }).click();
  await rows.nth(3).waitFor();
  await on.getByRole("link", { name: "begun" }).click();
  await on.locator("text=No pattern has been simulated yet").waitFor();
  await on.goBack();
  await rows.nth(3).waitFor();
  await on.goto(`${several.url}#/run/films/game`);
  await on.locator(".wait", { hasText: "manifest.json" }).waitFor();
  assert.deepEqual(on.troubles.filter((t) => !/status of 503/.test(t)), []);
  await leave(on);
  const phone = await visit(several.url, { width: 375, height: 740, touch: true });
  await phone.locator(".trends canvas").nth(2).waitFor();
  assert.ok((await phone.evaluate(() => document.documentElement.scrollWidth)) <= 375, "the list is wider than the phone");
  await photograph(phone, "phone-runs", true);
  await leave(phone);
  await several.close();
});

test("what is not there is not promised once the game is over", async () => {
  const finished = await openDashboard(game.folder);
  const none = (r) => ({ ...r, verdict: null });
  const changes = { "/api/rounds": (said) => ({ ...said, rounds: said.rounds.map(none) }) };
  const on = await visitWith(`${finished.url}#diagnosis`, changes);
  await on.locator(".wait", { hasText: "No diagnosis was made: the game ended before" }).waitFor();
  await leave(on);
  const open = (r) => ({ ...none(r), summary: r.summary && { ...r.summary, last: false } });
  const live = await visitWith(`${finished.url}#diagnosis`, {
    "/api/rounds": (said) => ({ ...said, rounds: said.rounds.map(open) }),
  });
  await live.locator(".wait", { hasText: "There is no diagnosis yet" }).waitFor();
  await leave(live);
  const off = await visitWith(`${finished.url}#diagnosis`, { ...changes, "/api/run": (run) => ({ ...run, diagnosis: false }) });
  await off.locator(".wait", { hasText: "The scenario turns the diagnosis off" }).waitFor();
  await leave(off);
  await finished.close();
});

/** The file that a button of a page saves; its name begins with the run's. */
async function savedFrom(page, button) {
  const { name, bytes } = await download(page, button);
  assert.match(name, /^game-/);
  return bytes;
}

/** What is written in a saved picture, which must be well-formed. */
const textsOf = (page, svg) =>
  page.evaluate((source) => {
    const picture = new DOMParser().parseFromString(source, "image/svg+xml");
    const fault = picture.querySelector("parsererror");
    if (fault) throw new Error(fault.textContent);
    return [...picture.querySelectorAll("text")].map((t) => t.textContent);
  }, svg.toString());

test("pictures and tables can be saved", async () => {
  const finished = await openDashboard(game.folder);
  const saving = await visit(finished.url);
  const saved = (label) => savedFrom(saving, saving.getByLabel(label, { exact: true }));
  await saving.locator(".trends .chart").first().waitFor();
  await saving.locator(".catcher").waitFor();
  const gamut = await saved("gamut as SVG");
  const words = await textsOf(saving, gamut);
  assert.ok(words.some((w) => w.startsWith("Young's modulus")), words.join());
  assert.match(gamut.toString(), /<title>game: Gamut: toughness against Young's modulus<\/title>/);
  assert.ok(words.some((w) => w.startsWith("game: Gamut")), words.join());
  const fronts = [...gamut.toString().matchAll(/<path d="([^"]+)"[^>]*stroke-width="1\.8"/g)];
  assert.ok(fronts.length > 0);
  for (const step of fronts.flatMap(([, path]) => path.split("M").filter(Boolean))) {
    const [from, to] = step.split("L").map((place) => place.trim().split(" "));
    assert.ok(!to || from[0] === to[0] || from[1] === to[1], `a front is a staircase: ${step}`);
  }
  // On the page the keys stand outside of the chart.
  for (const key of ["front of gamut 1", "measured", "proposals"]) assert.ok(words.includes(key), key);
  assert.equal((await saved("gamut as PNG")).subarray(1, 4).toString(), "PNG");
  assert.match((await saved("gamut as CSV")).toString(), /^round,pattern,modulus_pa,toughness_pa\n1,[0-9a-f]{14},/);
  assert.match(
    (await saved("Rounds as CSV")).toString(),
    /^round,gamut_hypervolume_gpa_mpa,measured_hypervolume_gpa_mpa,hypervolume_error_gpa_mpa,gap_gpa_mpa,/,
  );
  assert.match(
    (await saved("Measured patterns as CSV")).toString(),
    /^design,round,rigid_fraction,modulus_pa,modulus_sd_pa,toughness_pa,toughness_sd_pa,.*\n[0-9a-f]{14},\d+,[\d.]+,\d{8,}/,
  );
  assert.ok((await textsOf(saving, await saved("gap as SVG"))).length > 0);
  assert.deepEqual(saving.troubles, []);
  await leave(saving);
  await finished.close();
});

test("everything is reached with the keyboard alone", async () => {
  const finished = await openDashboard(game.folder);
  const keys = await visit(finished.url, { calm: true });
  await keys.locator(".catcher").waitFor();
  const focused = () =>
    keys.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.innerText);
  const tabTo = (what) =>
    until(
      async () => (await keys.keyboard.press("Tab"), what.test((await focused()) ?? "")),
      10,
      `Tab reaches ${what}`,
    );
  await tabTo(/to the content/);
  await tabTo(/Laboratory/);
  await tabTo(/points of the gamut/);
  await pointWithKeys(keys);
  await keys.keyboard.press("ArrowUp");
  assert.match(await pointedAt(keys), /^[0-9a-f]{14}$/);
  assert.match(await keys.locator(".catcher .for-reader").innerText(), /gigapascal/);
  await keys.keyboard.press("Enter");
  await keys.locator(".film canvas").waitFor({ timeout: 40_000 });
  assert.equal(await frameOf(keys), 0); // who wants less motion starts films by hand
  await tabTo(/moment of the film/);
  await keys.keyboard.press("ArrowRight");
  assert.equal(await frameOf(keys), 1);
  const unnamed = await keys.evaluate(() =>
    [...document.querySelectorAll("button, a, input, select, [tabindex='0'], [role='img']")]
      .filter(
        (e) =>
          !e.closest("[aria-hidden='true']") &&
          !(
            e.getAttribute("aria-label") ||
            e.innerText?.trim() ||
            e.labels?.length ||
            e.getAttribute("aria-labelledby")
          ),
      )
      .map((e) => e.outerHTML.slice(0, 120)),
  );
  assert.deepEqual(unnamed, []);
  assert.deepEqual(keys.troubles, []);
  await leave(keys);
  await finished.close();
});

test("a phone shows every view without scrolling sideways", async () => {
  const finished = await openDashboard(game.folder);
  const phone = await visit(finished.url, { width: 375, height: 740, touch: true });
  for (const name of ["game", "laboratory", "diagnosis", "families", "explorer", "nodes", "words"]) {
    await phone.goto(`${finished.url}#${name}`);
    await phone.locator(".panel").first().waitFor({ timeout: 40_000 });
    await phone.waitForTimeout(500);
    assert.ok(
      (await phone.evaluate(() => document.documentElement.scrollWidth)) <= 375,
      `${name} is wider than the phone`,
    );
    await photograph(phone, `phone-${name}`, true);
  }
  assert.deepEqual(phone.troubles, []);
  await leave(phone);
  await finished.close();
});

/** Milliseconds until the page shows its gamut of at least `count` points, and until a point is found under the pointer
 *  (median of ten). */
async function shownAndPointed(run, count, picture) {
  const dashboard = await openDashboard(run);
  const begun = Date.now();
  const on = await visit(dashboard.url);
  await on.locator(".catcher").waitFor();
  const hasCome = (bytes) =>
    performance
      .getEntriesByType("resource")
      .some((r) => r.name.includes("/api/gamut") && r.responseEnd > 0 && r.encodedBodySize > bytes);
  await until(() => on.evaluate(hasCome, 16 * count), 60, "the gamut has come");
  await on.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const shown = Date.now() - begun;
  await on.locator(".catcher").focus();
  await pointWithKeys(on);
  const [x, y] = await ringAt(on);
  await on.mouse.move(x, y);
  const times = [];
  for (let i = 0; i < 10; ++i) {
    await on.mouse.move(5, 5);
    await until(async () => (await pointedAt(on)) === "", 10, "nothing is pointed at");
    const before = Date.now();
    await on.mouse.move(x, y);
    await until(async () => (await pointedAt(on)) !== "", 10, "a point is found");
    times.push(Date.now() - before);
  }
  if (picture) await photograph(on, picture);
  assert.deepEqual(on.troubles, []);
  await leave(on);
  await dashboard.close();
  return { shown, pointed: times.sort((a, b) => a - b)[5] };
}

test("100,000 points are shown and pointed at nearly as fast as a few", async () => {
  // One after the other, so that the load of the machine counts for both.
  const few = await shownAndPointed(game.folder, 10);
  const many = await shownAndPointed(withManyPatterns(game.folder, 100_000), 100_000, "many-points");
  console.log(`few points ${JSON.stringify(few)} ms, 100,000 ${JSON.stringify(many)} ms`);
  assert.ok(many.shown < 2.5 * few.shown, `shown after ${many.shown} ms, a few after ${few.shown} ms`);
  assert.ok(many.pointed < 2.5 * few.pointed, `pointed at in ${many.pointed} ms, a few in ${few.pointed} ms`);
});

test("other pages, names and files get nothing", async () => {
  const guarded = await openDashboard(game.folder, "--token", "0123456789abcdef-test");
  const { port, hostname } = new URL(guarded.url);
  const ask = (path, headers = {}, method = "GET", body = "") =>
    new Promise((done, fail) => {
      const asked = request(
        {
          host: hostname,
          port,
          path,
          method,
          headers: { ...headers, ...(method === "POST" ? { "content-length": Buffer.byteLength(body) } : {}) },
        },
        (answer) => {
          answer.resume();
          answer.on("end", () => done(answer));
        },
      );
      asked.on("error", fail);
      asked.end(body);
    });
  const known = { authorization: "Bearer 0123456789abcdef-test" };
  const entry = { ...known, "x-nacre": "1", "content-type": "application/json" };
  assert.equal((await ask("/api/run")).statusCode, 401);
  assert.equal((await ask("/api/run", known)).statusCode, 200);
  assert.equal((await ask("/api/run", { ...known, host: "evil.example" })).statusCode, 421);
  assert.equal((await ask("/..%2f..%2fmanifest.json", known)).statusCode, 404);
  assert.equal(
    (await ask("/api/review", { ...known, "content-type": "application/json" }, "POST", "{}")).statusCode,
    403,
  );
  assert.equal((await ask("/api/review", { ...entry, origin: "http://evil.example" }, "POST", "{}")).statusCode, 403);
  assert.equal((await ask("/api/review", entry, "POST", "{}")).statusCode, 400);
  assert.equal(
    (await ask("/api/review", entry, "POST", " ".repeat(5 << 20)).catch(() => ({ statusCode: 413 }))).statusCode,
    413,
  );
  const visited = await visit(guarded.url);
  await visited.locator(".standing").waitFor();
  assert.ok(!visited.url().includes("token"));
  assert.deepEqual(visited.troubles, []);
  await leave(visited);
  await guarded.close();
});
