// At the testing machine with a phone in one hand: a measurement is entered, judged and photographed.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { browser, leave, photograph, visit } from "./browser.mjs";
import { endAll, openDashboard, playGame, ROOT, until } from "./games.mjs";

const WIDTH = 375;
const THUMB = 44; // points that a thumb hits

const game = await playGame(join(ROOT, "tests/web/person.toml"), "phone");
const served = await openDashboard(game.folder);
const phone = await visit(`${served.url}#laboratory`, { width: WIDTH, height: 740, touch: true });
phone.setDefaultTimeout(30_000);
after(async () => {
  await browser.close();
  endAll();
});

/** Whatever can be tapped is large enough and on the screen, and nothing is scrolled sideways. */
async function fitsAThumb(where) {
  const faults = await phone.evaluate(
    ([width, thumb]) => {
      const seen = [...document.querySelectorAll("main :is(button, input, select, summary, a.button)")].filter(
        (one) => one.checkVisibility() && !one.matches('[type="checkbox"], [type="file"], .sort'),
      );
      const faults = seen.flatMap((one) => {
        const { left, right, width: own, height } = one.getBoundingClientRect();
        const name = `${one.tagName} ${one.getAttribute("aria-label") ?? one.name ?? ""} ${one.textContent.trim().slice(0, 30)}`;
        const isLarge = height >= thumb - 0.5 && own >= thumb - 0.5;
        return isLarge && left >= 0 && right <= width ? [] : [`${name}: ${own} x ${height} at ${left}`];
      });
      const wide = [...document.querySelectorAll(".wide")].filter((one) => one.scrollWidth > one.clientWidth + 1);
      faults.push(...wide.map((one) => `${one.getAttribute("aria-label")} is ${one.scrollWidth} wide`));
      if (document.documentElement.scrollWidth > width) faults.push(`the page is ${document.documentElement.scrollWidth} wide`);
      return faults;
    },
    [WIDTH, THUMB],
  );
  await photograph(phone, `phone-${where}`, true);
  assert.deepEqual(faults, [], where);
}

test("a measurement is entered by its order", async () => {
  await phone.locator('select[name="order"] option', { hasText: "soft" }).first().waitFor({ state: "attached", timeout: 60_000 });
  await phone.locator('select[name="order"]').selectOption("r1/soft/modulus");
  assert.equal(await phone.locator('input[name="pattern"]').inputValue(), "soft");
  await phone.locator('input[name="value"]').fill("0,0007");
  await fitsAThumb("enter");
  await phone.getByRole("button", { name: "Add measurement" }).tap();
  await phone.locator(".notice", { hasText: "was added to the run" }).waitFor();
});

const review = () => phone.getByRole("region", { name: /^Review/ });

test("a specimen is judged where its value is seen", async () => {
  const row = review().locator("tbody tr").first();
  await row.getByRole("button", { name: /^review/ }).waitFor();
  const columns = await row.locator("td").evaluateAll((cells) => cells.filter((c) => c.checkVisibility()).map((c) => c.innerText));
  assert.match(columns.join("|"), /modulus.*\|0\.0007.*\|valid\|/s);
  await row.getByRole("button", { name: /^review/ }).tap();
  await row.locator("input").fill("the grip slipped");
  await fitsAThumb("judge");
  await row.getByRole("button", { name: "not valid" }).tap();
  await row.locator(".chip.rejected").waitFor();
  await fitsAThumb("laboratory");
});

test("it is photographed on its own page", async () => {
  await review().locator("tbody tr a").first().tap();
  await phone.locator("h2", { hasText: /^Specimen / }).waitFor();
  await phone.locator(".notes summary").tap();
  const picture = await phone.evaluate(async () => {
    const canvas = new OffscreenCanvas(300, 400);
    canvas.getContext("2d").fillRect(0, 0, 300, 200);
    return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
  });
  const camera = { name: "crack.png", mimeType: "image/png", buffer: Buffer.from(picture) };
  await phone.locator('.notes input[type="file"]').setInputFiles(camera);
  await phone.locator("text=crack.png goes with it").waitFor();
  await phone.getByLabel(/^note on specimen/).fill("slipped from the upper grip");
  await fitsAThumb("photograph");
  await phone.getByRole("button", { name: "Keep the note" }).tap();
  await until(() => phone.locator(".notes img").evaluate((img) => img.complete && img.naturalWidth === 300), 20, "shown");
  assert.deepEqual(phone.troubles, []);
  await leave(phone);
});
