"""Commands from outside: 64 worlds in step, each relay told how fast to fly by whatever the program computes.

    python examples/env.py

prints

    64 worlds, 3 relays each; 600 decisions
    head 8.0 m in on average, links within 1.1 dB
    the truth, which no law sees: 64 heads in the air at the end
"""

import numpy as np

import uchain

env = uchain.ChainEnv("corner", worlds=64, seed=1)
seen, decisions = env.reset(), 0
while not env.done.all():
    # Arrays of (worlds, relays); NaN where a relay does not level now.
    imbalance_db = np.where(seen.asks, seen.front_db - seen.back_db, np.float32(0))
    seen = env.step(np.clip(imbalance_db / np.float32(15), -0.3, 0.3))
    decisions += 1

print(f"{env.worlds} worlds, {env.relays} relays each; {decisions} decisions")
summaries = env.summaries()
reach_m = np.mean([summary.head_reach_m for summary in summaries])
spread_db = np.mean([summary.spread_db for summary in summaries])
print(f"head {reach_m:.1f} m in on average, links within {spread_db:.1f} dB")
print(f"the truth, which no law sees: {env.truth().airborne[:, 0].sum()} heads in the air at the end")
