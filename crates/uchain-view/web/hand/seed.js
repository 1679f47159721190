// Seeds: whole numbers up to 2 to the 64th. JavaScript rounds numbers beyond 2 to the 53rd, and a rounded seed is another
// flight; so those are their digits.

/** What a seed may be, for people. */
export const SEEDS = "a whole number from 0 to 18446744073709551615";

/** A seed as the engine takes it, a number or its digits; null = it is none. @param {string|number} written */
export function seedOf(written) {
  if (typeof written === "number") return Number.isSafeInteger(written) && written >= 0 ? written : null;
  const digits = String(written).trim();
  if (!/^\d{1,20}$/.test(digits)) return null;
  const seed = BigInt(digits);
  if (seed >= 1n << 64n) return null;
  return seed <= BigInt(Number.MAX_SAFE_INTEGER) ? Number(seed) : String(seed);
}
