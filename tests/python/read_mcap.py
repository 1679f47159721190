"""A recording, read and decoded by the format's own Python library, checksums on.

Usage: read_mcap.py run.mcap inspect.json

inspect.json is what `uchain inspect run.mcap --json` prints: both readers have to find the same numbers.
"""

import json
import math
import struct
import sys
from collections import Counter

from mcap.reader import SeekingReader
from mcap.records import Attachment, DataEnd, Metadata
from mcap.stream_reader import StreamReader
from mcap_protobuf.decoder import DecoderFactory

TICK_NS = 50_000_000


def f32(value):
    """The f32 nearest to a number that was printed."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def same(recorded, printed):
    return math.isnan(recorded) if printed is None else recorded == f32(printed)


def from_front_to_back(path):
    """Every record, each checksum checked; metadata and attachments by name."""
    named = {}
    with open(path, "rb") as file:
        for record in StreamReader(file, validate_crcs=True).records:
            if isinstance(record, (Metadata, Attachment)):
                named[record.name] = record
            if isinstance(record, DataEnd):
                assert record.data_section_crc != 0, "the data have no checksum"
    return named


def decoded(path):
    """Every message through the index, by topic."""
    topics = {}
    with open(path, "rb") as file:
        reader = SeekingReader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message, value in reader.iter_decoded_messages():
            topics.setdefault((channel.topic, schema.name), []).append((message.log_time, value))
        counts = reader.get_summary().statistics.channel_message_counts
    assert sum(counts.values()) == sum(map(len, topics.values())), "the index counts other messages"
    return topics


def check_frames(frames, ticks):
    assert [time for time, _ in frames] == [TICK_NS * (i + 1) for i in range(ticks)]
    for i, (_, frame) in enumerate(frames):
        assert frame.tick == i + 1
        uavs = len(frame.x_m)
        for name in (
            "y_m heading_rad forward_mps lateral_mps yaw_rate_radps airborne wall_contacts uav_contacts"
        ).split():
            assert len(getattr(frame, name)) == uavs, name
        assert len(frame.tof_m) in (0, 4 * uavs)
        assert len(frame.link_uav) == len(frame.link_true_db) == len(frame.link_filtered_db) == len(frame.link_raw_db)
    assert any(len(frame.tof_m) for _, frame in frames) and any(len(frame.link_uav) for _, frame in frames)


def check_moments(frames, metrics, moments):
    """The numbers that `inspect` read are those in the messages."""
    metrics = dict(metrics)
    for moment in moments:
        tick = round(moment["time_s"] * 20)
        frame, metric = frames[tick - 1][1], metrics[tick * TICK_NS]
        assert frame.decision
        assert sum(frame.airborne) == metric.uavs == moment["uavs"]
        assert sum(frame.wall_contacts) == metric.wall_contacts == moment["wall_contacts"]
        assert sum(frame.uav_contacts) // 2 == metric.uav_contacts == moment["uav_contacts"]
        assert metric.connected == moment["connected"]
        for value in (frame.head_reach_m, metric.head_reach_m):
            assert same(value, moment["head_reach_m"]), (tick, value)
        assert same(max(frame.link_true_db, default=math.nan), moment["worst_link_db"])
        assert same(metric.worst_link_db, moment["worst_link_db"])
        assert same(metric.spread_db, moment["spread_db"])


def check_poses(frames, topics):
    """Foxglove's messages say the same places as our own."""
    transforms = topics["/tf", "foxglove.FrameTransforms"]
    poses = topics["/poses", "foxglove.PosesInFrame"]
    assert [t.child_frame_id for t in transforms[0][1].transforms][:2] == ["map", "uav_0"]
    assert len(poses) == len(frames) // 2, "ten a second"
    for time, message in poses:
        frame = frames[time // TICK_NS - 1][1]
        assert message.frame_id == "map"
        assert [(pose.position.x, pose.position.y) for pose in message.poses] == list(zip(frame.x_m, frame.y_m))
    for time, message in transforms[1:]:
        frame = frames[time // TICK_NS - 1][1]
        for transform in message.transforms:
            uav = int(transform.child_frame_id.removeprefix("uav_"))
            heading_rad = 2 * math.atan2(transform.rotation.z, transform.rotation.w)
            assert transform.translation.x == frame.x_m[uav] and transform.translation.y == frame.y_m[uav]
            assert math.isclose(math.cos(heading_rad), math.cos(frame.heading_rad[uav]), abs_tol=1e-6)


def check_scans(frames, topics, walls):
    """Beams end at walls: every hit lies within the noise of the sensor of the box around all walls."""
    scans = topics["/tof/uav_0", "foxglove.LaserScan"]
    for time, scan in scans:
        # Read at the start of the next tick: front left is the third of four beams.
        frame = frames[time // TICK_NS][1]
        assert scan.frame_id == "uav_0" and len(scan.ranges) == 4
        assert scan.ranges[2] == frame.tof_m[0] and scan.ranges[0] == frame.tof_m[3]
    xs, ys = zip(*(map(float, line.split(",")[1:]) for line in walls.splitlines()[1:]))
    hits = topics["/hits", "foxglove.PointCloud"]
    points = [point for _, cloud in hits for point in struct.iter_unpack("<fffI", cloud.data)]
    assert points, "no beam ever met a wall"
    for x, y, z, _ in points:
        assert min(xs) - 0.1 < x < max(xs) + 0.1 and min(ys) - 0.1 < y < max(ys) + 0.1 and z == 0


def check_points(frames, topics, walls):
    """Points for viewers that draw no lines: walls once, UAVs where they are, links between them."""
    xs, ys = zip(*(map(float, line.split(",")[1:]) for line in walls.splitlines()[1:]))
    cloud = lambda topic: topics[topic, "foxglove.PointCloud"]
    unpacked = lambda message: list(struct.iter_unpack("<fffBBBB", message.data))
    [(time, message)] = cloud("/points/walls")
    assert time == 0 and [field.name for field in message.fields] == "x y z red green blue alpha".split()
    for x, y, _, *_, alpha in unpacked(message):
        assert min(xs) - 1e-3 <= x <= max(xs) + 1e-3 and min(ys) - 1e-3 <= y <= max(ys) + 1e-3 and alpha == 255
    assert len(cloud("/points/uavs")) == len(frames) // 4, "five a second"
    for time, message in cloud("/points/uavs"):
        frame = frames[time // TICK_NS - 1][1]
        dots = unpacked(message)
        assert [point[:2] for point in dots[::3]] == list(zip(frame.x_m, frame.y_m))
        assert [point[3:6] == (128, 128, 128) for point in dots[::3]] == [not up for up in frame.airborne]
    for time, message in cloud("/points/links"):
        frame = frames[time // TICK_NS - 1][1]
        assert 4 * len(frame.link_uav) <= len(unpacked(message)) <= 8 * len(frame.link_uav)


def check_exploration(topics, inspected):
    """Frames, rounds, stars and ways of an exploration say the same."""
    frames = topics["/frame", "uchain.ExploreFrame"]
    assert [time for time, _ in frames] == [TICK_NS * (i + 1) for i in range(inspected["ticks"])]
    robots, nodes = len(frames[0][1].x_m), sum(len(frame.node_robot) for _, frame in frames)
    assert nodes == sum(inspected["nodes"]) and frames[-1][1].stopped == 1 and frames[-1][1].hubs == 0
    assert sum(len(frame.edge_robot) for _, frame in frames) == 2 * inspected["edges"]
    metrics = dict(topics["/metrics", "uchain.ExploreMetrics"])
    for now in inspected["progress"]:
        metric = metrics[round(now["time_s"] * 20) * TICK_NS]
        for name in "rounds nodes edges hubs moving distance_m wall_contacts robot_contacts".split():
            assert getattr(metric, name) == now[name], (name, now)
    assert math.isclose(now["distance_m"], sum(inspected["distance_m"]), rel_tol=1e-9)
    for time, message in topics["/poses", "foxglove.PosesInFrame"]:
        frame = frames[time // TICK_NS - 1][1]
        places = [(pose.position.x, pose.position.y, pose.position.z) for pose in message.poses]
        assert places == list(zip(frame.x_m, frame.y_m, frame.z_m))
    stars = {e.id: e for _, m in topics["/stars", "foxglove.SceneUpdate"] for e in m.entities}
    assert len(stars) == nodes
    # In the end an outline is left of every star, and no frontier.
    assert all(len(star.lines) == 1 for star in stars.values())
    assert len(topics["/robots", "foxglove.SceneUpdate"][0][1].entities) == robots
    assert all(len(cloud.data) == robots * 3 * 16 for _, cloud in topics["/points/robots", "foxglove.PointCloud"])
    flown = sum(len(m.entities) for _, m in topics["/ways", "foxglove.SceneUpdate"])
    assert flown == sum(inspected["moves"]), flown
    assert topics["/log", "foxglove.Log"][-1][1].message == "over: no frontier left, all home"


def main(path, printed):
    named = from_front_to_back(path)
    with open(printed, encoding="utf-8") as file:
        inspected = json.load(file)
    about = named["uchain"].metadata
    assert about["seed"] == str(inspected["seed"]) and about["version"] == inspected["version"]
    assert f'name = "{inspected["scenario"]}"' in about["scenario"]
    walls = named["walls.csv"].data.decode()

    topics = decoded(path)
    if "progress" in inspected:
        check_exploration(topics, inspected)
    else:
        check_chain(topics, inspected, walls)
    counts = Counter({topic: len(messages) for (topic, _), messages in topics.items()})
    print(f"{sum(counts.values())} messages on {len(counts)} topics decoded, checksums right: {dict(counts)}")


def check_chain(topics, inspected, walls):
    frames = topics["/frame", "uchain.Frame"]
    check_frames(frames, inspected["ticks"])
    check_moments(frames, topics["/metrics", "uchain.Metrics"], inspected["moments"])
    check_poses(frames, topics)
    check_scans(frames, topics, walls)
    check_points(frames, topics, walls)
    assert [e.id for e in topics["/map", "foxglove.SceneUpdate"][0][1].entities] == ["walls", "base"]
    bodies = topics["/uavs", "foxglove.SceneUpdate"]
    launches = len(inspected["launches_s"])
    assert len(bodies[0][1].entities) == len(frames[0][1].x_m) and len(bodies) >= 1 + launches
    assert any(e.lines[0].points for _, m in topics["/links", "foxglove.SceneUpdate"] for e in m.entities)
    said = [message.message for _, message in topics["/log", "foxglove.Log"]]
    assert sum("took off" in words for words in said) == launches, said


if __name__ == "__main__":
    main(*sys.argv[1:])
