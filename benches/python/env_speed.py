"""Relay decisions per second of `uchain.ChainEnv` with Eq. 12 in numpy in the loop, on one core: medians.

    python benches/python/env_speed.py [worlds] [scenario]

Every entry (world, relay) of a step counts that a relay asks for: a relay on the ground counts for nothing.
"""

import statistics
import sys
import time

import numpy as np

import uchain

REPEATS = 5


def fly(env: uchain.ChainEnv) -> tuple[int, int, float]:
    """Relay decisions, steps, and how long they took (s)."""
    asked = steps = 0
    seen = env.reset()
    gain = np.float32(3) * env.params.k_db_per_m
    period_s, v_max_mps = env.params.decision_s, env.params.v_max_mps
    start = time.perf_counter()
    while not env.done.all():
        s_d = seen.front_db - seen.back_db
        asked += np.count_nonzero(seen.asks)
        seen = env.step(np.clip(s_d / gain / period_s, -v_max_mps, v_max_mps))
        steps += 1
    return int(asked), steps, time.perf_counter() - start


def main() -> None:
    worlds = int(sys.argv[1]) if len(sys.argv) > 1 else 256
    scenario = sys.argv[2] if len(sys.argv) > 2 else "corner"
    env = uchain.ChainEnv(scenario, worlds=worlds)
    rates, steps_s = [], []
    for _ in range(REPEATS):
        asked, steps, took_s = fly(env)
        rates.append(asked / took_s)
        steps_s.append(took_s / steps)
    print(f"{scenario}, {worlds} worlds of {env.relays} relays, median of {REPEATS} flights:")
    print(f"{statistics.median(rates):,.0f} relay decisions/s ({min(rates):,.0f} to {max(rates):,.0f})")
    print(f"{1e6 * statistics.median(steps_s):,.0f} µs a step")


if __name__ == "__main__":
    main()
