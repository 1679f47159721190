"""Relay decisions per second of `uchain.ChainEnv` with Eq. 12 in numpy in the loop, on one core: medians, in processor time.

    python benches/python/env_speed.py [worlds] [scenario]

Two rates: speeds that a relay asked for and got, for one on the ground asks for none; and all (worlds, relays) of a step.
The flights themselves, sensors and radio at 20 Hz included, take most of the time: a sweep of as many runs is shown beside.
"""

import statistics
import sys
import time

import numpy as np

import uchain

REPEATS = 5


def fly(env: uchain.ChainEnv) -> tuple[int, int, float]:
    """Relay decisions, steps, and how long they took in processor time (s)."""
    asked = steps = 0
    seen = env.reset()
    gain = np.float32(3) * env.params.k_db_per_m
    period_s, v_max_mps = env.params.decision_s, env.params.v_max_mps
    start = time.process_time()
    while not env.done.all():
        s_d = seen.front_db - seen.back_db
        asked += np.count_nonzero(seen.asks)
        seen = env.step(np.clip(s_d / gain / period_s, -v_max_mps, v_max_mps))
        steps += 1
    return int(asked), steps, time.process_time() - start


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
    step_s = statistics.median(steps_s)
    print(f"{statistics.median(rates):,.0f} speeds asked for and given a second ({min(rates):,.0f} to {max(rates):,.0f})")
    print(f"{worlds * env.relays / step_s:,.0f} worlds x relays a second, {1e6 * step_s:,.0f} µs a step")
    start = time.process_time()
    uchain.sweep(scenario, replicates=worlds, threads=1, progress=False)
    swept_s = time.process_time() - start
    print(f"{step_s * steps:.3f} s a flight of all worlds; {swept_s:.3f} s a sweep of as many runs by the built-in law")


if __name__ == "__main__":
    main()
