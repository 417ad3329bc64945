// The files of a ZIP, as a person's program unpacks them.

import { inflateRawSync } from "node:zlib";

const END = 0x06054b50; // of the central directory
const LOCAL_HEAD = 30;

/** Contents by path. */
export function unzipped(zip) {
  let end = zip.length - 22;
  while (zip.readUInt32LE(end) !== END) --end;
  const files = new Map();
  let at = zip.readUInt32LE(end + 16);
  for (let count = zip.readUInt16LE(end + 10); count > 0; --count) {
    const method = zip.readUInt16LE(at + 10);
    const size = zip.readUInt32LE(at + 20);
    const [nameSize, extraSize, commentSize] = [28, 30, 32].map((place) => zip.readUInt16LE(at + place));
    const head = zip.readUInt32LE(at + 42);
    const begin = head + LOCAL_HEAD + zip.readUInt16LE(head + 26) + zip.readUInt16LE(head + 28);
    const packed = zip.subarray(begin, begin + size);
    const name = zip.toString("utf8", at + 46, at + 46 + nameSize);
    files.set(name, method === 0 ? packed : inflateRawSync(packed));
    at += 46 + nameSize + extraSize + commentSize;
  }
  return files;
}
