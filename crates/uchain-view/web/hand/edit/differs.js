// Which lines of two texts differ.

/** Texts with more lines are compared without looking for what moved. */
const MOST_LINES = 1500;

/**
 * Lines only in the one or the other, in order, comments and blank lines left out.
 * @returns {{before: string[], after: string[]}}
 */
export function differingLines(one, other) {
  const a = one.split("\n").map((line) => line.trim()).filter(isMeant);
  const b = other.split("\n").map((line) => line.trim()).filter(isMeant);
  let from = 0;
  while (from < a.length && from < b.length && a[from] === b[from]) from += 1;
  let [endA, endB] = [a.length, b.length];
  while (endA > from && endB > from && a[endA - 1] === b[endB - 1]) [endA, endB] = [endA - 1, endB - 1];
  const [before, after] = [a.slice(from, endA), b.slice(from, endB)];
  if (before.length * after.length > MOST_LINES * MOST_LINES || before.length === 0 || after.length === 0) return { before, after };
  return parted(before, after);
}

const isMeant = (line) => line !== "" && !line.startsWith("#");

/** What is not in the longest common sequence. */
function parted(a, b) {
  const width = b.length + 1;
  const longest = new Uint16Array((a.length + 1) * width);
  for (let i = a.length - 1; i >= 0; i -= 1) {
    for (let j = b.length - 1; j >= 0; j -= 1) {
      longest[i * width + j] = a[i] === b[j] ? longest[(i + 1) * width + j + 1] + 1 : Math.max(longest[(i + 1) * width + j], longest[i * width + j + 1]);
    }
  }
  const [before, after] = [[], []];
  let [i, j] = [0, 0];
  while (i < a.length || j < b.length) {
    if (i < a.length && j < b.length && a[i] === b[j]) [i, j] = [i + 1, j + 1];
    else if (j >= b.length || (i < a.length && longest[(i + 1) * width + j] >= longest[i * width + j + 1])) before.push(a[i++]);
    else after.push(b[j++]);
  }
  return { before, after };
}
