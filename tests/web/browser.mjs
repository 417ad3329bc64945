// Chromium, watched: errors in the console and requests to elsewhere are kept, screenshots go to one folder.

import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { BUILD, ROOT } from "./games.mjs";

const { chromium } = createRequire(join(ROOT, "web/package.json"))("playwright-core");
const SCREENSHOTS = join(BUILD, "web-screenshots");
mkdirSync(SCREENSHOTS, { recursive: true });

const program = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
// No sandbox: the test already runs in namespaces of its own, as their root.
export const browser = await chromium.launch({
  executablePath: program,
  args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
});

/** A page on `url`, with what went wrong on it in `page.troubles`. */
export async function visit(url, { width = 1360, height = 900, dark = false, touch = false, calm = false } = {}) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    hasTouch: touch,
    isMobile: touch,
    reducedMotion: calm ? "reduce" : "no-preference",
    acceptDownloads: true,
  });
  const page = await context.newPage();
  page.troubles = [];
  page.setDefaultTimeout(20_000);
  page.on(
    "console",
    (message) => ["error", "warning"].includes(message.type()) && page.troubles.push(`console: ${message.text()}`),
  );
  page.on("pageerror", (error) => page.troubles.push(`error: ${error.message}`));
  page.on("request", (request) => {
    const to = request.url();
    if (!to.startsWith(new URL(url).origin) && !/^(blob|data):/.test(to))
      page.troubles.push(`request to elsewhere: ${to}`);
  });
  await page.goto(url, { timeout: 60_000 }); // Chromium begins slowly on a busy machine
  return page;
}

/** The page, with the server's responses changed: by path, a function of the response. */
export async function visitWith(url, changes, how = {}) {
  const page = await visit(url, how);
  for (const [path, change] of Object.entries(changes))
    await page.route(`**${path}`, async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, json: change(await response.json()) });
    });
  await page.reload();
  return page;
}

/** What a button saves. */
export async function savedFrom(page, button) {
  const [download] = await Promise.all([page.waitForEvent("download"), button.click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** Drops files of the testing machine, each a name and a text, on the page. */
export async function drop(page, files) {
  const transfer = await page.evaluateHandle((dropped) => {
    const data = new DataTransfer();
    for (const { name, text } of dropped) data.items.add(new File([text], name));
    return data;
  }, files);
  await page.locator(".import").dispatchEvent("drop", { dataTransfer: transfer });
}

/** Closes a page and all of its context; responses that are still on their way to it are no fault. */
export async function leave(page) {
  await page.unrouteAll({ behavior: "ignoreErrors" });
  await page.context().close();
}

export const photograph = (page, name, fullPage = false) =>
  page.screenshot({ path: join(SCREENSHOTS, `${name}.png`), fullPage });
