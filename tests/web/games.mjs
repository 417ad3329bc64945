// Real games and dashboards, ended with the test.

import { spawn, execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const ROOT = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const BUILD = process.argv[2] ?? join(ROOT, "build");
const NACRE = join(BUILD, "bin/nacre");

/** The runs that a file of tests plays; they stay until its next time, since a failure is understood from its run. */
export const folder = join(BUILD, "web-runs", basename(process.argv[1], ".mjs"));
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
// What was simulated for one file of tests serves the others.
mkdirSync(join(BUILD, "web-runs/virtual_lab.kept"), { recursive: true });
for (const cache of ["virtual_lab.kept", "simulations.db"]) symlinkSync(join("..", cache), join(folder, cache));
const children = new Set();
/** Ends every program that still runs: a test that failed may have left one. */
export function endAll() {
  for (const child of children) child.kill("SIGKILL");
}
process.on("exit", endAll);

/** A program, what it has printed, and how to wait for it. */
function start(program, args) {
  const child = spawn(program, args, { stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, USER: "web test" } });
  children.add(child);
  const running = {
    child,
    said: "",
    ended: new Promise((done) => child.once("exit", (code) => (children.delete(child), done(code)))),
  };
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (text) => (running.said += text));
  return running;
}

/** Waits until `condition` gives something; throws after so many seconds. */
export async function until(condition, seconds, what) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const found = await condition();
    if (found) return found;
    if (Date.now() > end) throw new Error(`not within ${seconds} s: ${what}`);
    await new Promise((done) => setTimeout(done, 100));
  }
}

/** `nacre launch` of a scenario; its folder is there when this returns. */
export async function playGame(scenario, name) {
  const game = start(NACRE, ["launch", scenario, "--logs", folder, "--run", name]);
  game.folder = join(folder, name);
  await until(
    () => existsSync(join(game.folder, "manifest.json")),
    20,
    `the run's folder; the launcher said ${game.said}`,
  );
  return game;
}

/** What a command of nacre's prints; throws where it ends with another status than 0. */
export const nacre = (...words) => execFileSync(NACRE, words, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });

/** `nacre dashboard` of a run, or of a list of them, with the address of its page. */
export async function openDashboard(run, ...options) {
  const dashboard = start(NACRE, ["dashboard", ...[run].flat(), "--port", "0", "--page", join(BUILD, "web"), ...options]);
  dashboard.url = await until(
    () => dashboard.said.match(/http:\S+/)?.[0],
    20,
    `the dashboard's address; it said ${dashboard.said}`,
  );
  dashboard.close = async () => {
    dashboard.child.kill("SIGINT");
    return dashboard.ended;
  };
  return dashboard;
}

/** A copy of a finished run that goes by the name; `isNew`: nothing has happened in it yet. */
export function renamed(run, name, isNew = false) {
  const copy = join(folder, name);
  execFileSync("cp", ["-r", run, copy]);
  const manifest = join(copy, "manifest.json");
  writeFileSync(manifest, JSON.stringify({ ...JSON.parse(readFileSync(manifest, "utf8")), run_id: name }));
  if (isNew) for (const part of ["run.db", "run.db-wal", "run.db-shm", "nodes"]) rmSync(join(copy, part), { recursive: true, force: true });
  return copy;
}

/** A GAMUT of `count` random patterns: `sound`, another one of `samples` patterns, with its content replaced. */
function gamutMessage(sound, samples, round, chunk, count) {
  const head = sound.subarray(0, sound.length - 24 * samples - 25); // fingerprint and blank header
  const body = Buffer.alloc(25 + 24 * count);
  body.writeInt32BE(round, 0);
  body.writeInt32BE(sound.readInt32BE(head.length + 4), 4); // base
  body.writeInt32BE(1_000_000, 8); // in all, at most
  body.writeInt8(sound.readInt8(head.length + 12), 12); // fidelity
  body.writeInt32BE(chunk, 13);
  body.writeInt32BE(chunk + 1, 17);
  body.writeInt32BE(count, 21);
  for (let i = 0; i < count; ++i) {
    body.writeBigInt64BE(BigInt(Math.floor(Math.random() * 2 ** 53)) * 4n, 25 + 8 * i);
    body.writeDoubleBE(2e9 * Math.random(), 25 + 8 * (count + i));
    body.writeDoubleBE(8e5 * Math.random() * Math.random(), 25 + 8 * (2 * count + i));
  }
  return Buffer.concat([head, body]);
}

/** A copy of a finished run whose last gamut has `count` patterns more. */
export function withManyPatterns(run, count) {
  const copy = `${run}-large`;
  execFileSync("cp", ["-r", run, copy]);
  const database = join(copy, "run.db");
  const newest = `SELECT round, hex(payload), (SELECT count(*) FROM samples WHERE message = id)
    FROM messages WHERE channel = 'GAMUT' ORDER BY round DESC LIMIT 1;`;
  const [round, hex, samples] = execFileSync("sqlite3", [database, newest], { encoding: "utf8" }).trim().split("|");
  const most = 1000; // of a message
  const inserts = Array.from({ length: Math.ceil(count / most) }, (_, i) => {
    const size = Math.min(most, count - i * most);
    const payload = gamutMessage(Buffer.from(hex, "hex"), Number(samples), Number(round), 1000 + i, size);
    return `INSERT INTO messages (channel, round, hash, payload, content)
      VALUES ('GAMUT', ${round}, 'made-up-${i}', X'${payload.toString("hex")}', '{}');`;
  });
  execFileSync("sqlite3", [database], { input: `BEGIN;${inserts.join("\n")}COMMIT;` });
  return copy;
}
