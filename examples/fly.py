"""A flight in Python: what it came to, and its numbers over time.

    python examples/fly.py

prints

    8.1 of 8.8 m flown; 3 links within 60 dB, the worst 56.5 dB; its link held the head back for 4.8 s, 1.0 m
    UAVs in the air after 60 s: 3
    19.65 s: UAV 1: took off
    20.25 s: UAV 0, the head: overridden (head-stop): it goes no farther, its link toward the base reads 70.5 dB, link.head_stop_db = 70
    digest 4cb3614f4c4f29fd

and leaves a picture, corner.png.
"""

import uchain

run = uchain.run("corner", seed=1)
print(run.verdict)

# Columns over time: (ticks, UAVs).
at_60_s = run.frames["time_s"].searchsorted(60)
print("UAVs in the air after 60 s:", run.frames["airborne"][at_60_s].sum())

for event in run.events:
    if event.kind in ("took-off", "override-begins", "override-ends"):
        print(f"{event.time_s:.2f} s: {event.text}")

# The same bits from the command line, from Rust, on any x86-64 CPU.
print("digest", run.digest)
run.plot("corner.png")
