// What the pilot wishes: speed in steps, and which way at a branch. It knows nothing of the page.

/** Ways at a branch, from left to right. */
export const WAYS = [
  { follow: "left", words: "Left", sign: "←" },
  { follow: "centre", words: "Straight", sign: "↑" },
  { follow: "right", words: "Right", sign: "→" },
];

/** A step of the speed (m/s), where full speed is at least two of them. */
const STEP_MPS = 0.05;
/** Faster than this nobody may be asked to fly (m/s). */
const MOST_MPS = 1;

export class Stick {
  /** @param {number} v_max_mps full speed: what relays keep up with */
  constructor(v_max_mps, speed_mps = 0, follow = "centre") {
    this.full_mps = Math.min(MOST_MPS, v_max_mps > 0 ? Number(v_max_mps.toFixed(4)) : 0.2);
    this.step_mps = this.full_mps >= 2 * STEP_MPS ? STEP_MPS : this.full_mps / 2;
    this.speed_mps = Math.min(MOST_MPS, Math.max(-MOST_MPS, speed_mps));
    this.follow = follow;
  }

  /** One step faster (1) or slower, then backward (-1). It always passes through standing still. */
  faster(by) {
    const now = this.speed_mps / this.step_mps;
    const next = by > 0 ? Math.floor(now + 1.001) : Math.ceil(now - 1.001);
    const past = (now > 0 && next < 0) || (now < 0 && next > 0);
    const wished_mps = past ? 0 : next * this.step_mps;
    const bounded_mps = Math.min(this.full_mps, Math.max(-this.full_mps, wished_mps));
    return this.#to(Number(bounded_mps.toFixed(4)), this.follow);
  }

  stop() {
    return this.#to(0, this.follow);
  }

  /** One way further to the left (-1) or right (1): from left it is straight on first, then right. */
  turn(by) {
    const at = WAYS.findIndex((way) => way.follow === this.follow);
    return this.take(WAYS[Math.min(WAYS.length - 1, Math.max(0, at + by))].follow);
  }

  take(follow) {
    return this.#to(this.speed_mps, follow);
  }

  /** True = something else is wished than before. */
  #to(speed_mps, follow) {
    const isNew = speed_mps !== this.speed_mps || follow !== this.follow;
    this.speed_mps = speed_mps === 0 ? 0 : speed_mps;
    this.follow = follow;
    return isNew;
  }
}
