"""A law of one's own in Python, in a flight and in a sweep, beside the built-in one.

    python examples/law.py

prints

    built-in: 7.99 m flown on average, links within 1.1 dB, 0 failed
    bang: 7.02 m flown on average, links within 1.8 dB, 1 failed
    gentle: 7.99 m flown on average, links within 0.9 dB, 0 failed
"""

import numpy as np

import uchain


def bang(seen: uchain.Seen) -> float:
    """Flies at one speed toward the worse link, and stays where they differ by less than 3 dB."""
    imbalance_db = seen.front_db - seen.back_db
    return 0.0 if abs(imbalance_db) < 3 else 0.15 * np.sign(imbalance_db)


@uchain.batched
def gentle(seen: uchain.SeenArrays) -> np.ndarray:
    """Half of Eq. 12, for all relays of all flights under way in one call."""
    imbalance_db = seen.front_db - seen.back_db
    return np.clip(imbalance_db / (6 * seen.params.k_db_per_m) / seen.params.decision_s, -0.3, 0.3)


for name, law in [("built-in", None), ("bang", bang), ("gentle", gentle)]:
    table = uchain.sweep("corner", replicates=20, seed=1, law=law, progress=False)
    reach_m, spread_db = table["head_reach_m"].mean(), np.nanmean(table["spread_db"])
    print(f"{name}: {reach_m:.2f} m flown on average, links within {spread_db:.1f} dB, {table.failed} failed")
