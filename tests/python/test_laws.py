"""The laws of uchain.laws: those that fly, called by hand."""

import math
import pickle

import numpy as np
import pytest

from uchain.laws import (
    Explorer,
    Heard,
    Node,
    Observation,
    ScalarKalman,
    center,
    equalize,
)


def test_leveling_is_equation_12_in_float32():
    f32 = np.float32
    for back, front in [(50.0, 53.0), (61.5, 60.25), (40.0, 90.0), (90.0, 40.0), (50.0, 50.0)]:
        s_d = f32(front) - f32(back)
        speed = s_d / (f32(3) * f32(25)) / f32(0.2)
        assert equalize(back, front) == float(np.clip(speed, f32(-0.3), f32(0.3)))
    assert equalize(50.0, 54.0, tolerance_db=5) == 0
    assert equalize(math.nan, 50.0) == 0 and equalize(50.0, math.inf) == 0


def test_parameters_are_checked_in_words():
    with pytest.raises(TypeError, match="unknown parameter 'k'; there are .*k_db_per_m"):
        equalize(50.0, 53.0, k=3)
    with pytest.raises(ValueError, match="k_db_per_m = 0: must lie in 0.1..=10000"):
        equalize(50.0, 53.0, k_db_per_m=0)
    with pytest.raises(ValueError, match="lipschitz"):
        equalize(50.0, 53.0, law="newton")
    with pytest.raises(ValueError, match="follow: 'up'; expected centre, left, right"):
        center(1, 1, 1, 1, follow="up")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="tof_range_m"):
        center(1, 1, 1, 1, tof_range_m=-1)


def reference(time_s, loss_db, separating_mps, r=5.0, q=0.5, a=10.7):
    """Equations 16 to 19 in float64, written from the paper."""
    estimate, variance, out = None, None, []
    for i, z in enumerate(loss_db):
        if estimate is not None:
            period = time_s[i] - time_s[i - 1]
            estimate += a * period * separating_mps[i]
            variance += q * period
        if math.isfinite(z):
            if estimate is None:
                estimate, variance = float(z), r
            else:
                gain = variance / (variance + r)
                estimate += gain * (z - estimate)
                variance *= 1 - gain
        out.append(math.nan if estimate is None else estimate)
    return np.array(out)


def test_a_log_is_filtered_as_the_paper_has_it():
    rng = np.random.default_rng(1)
    time_s = np.cumsum(rng.uniform(0.05, 0.5, 300))
    loss_db = (60 + rng.normal(0, 3, 300)).astype(np.float32)
    loss_db[[0, 7, 8, 100]] = np.nan
    speed = rng.normal(0, 0.2, 300).astype(np.float32)
    log = ScalarKalman.filter(time_s, loss_db, speed)
    expected = reference(time_s, loss_db, speed)
    np.testing.assert_allclose(log["loss_db"], expected, atol=1e-3)
    assert {name: column.dtype for name, column in log.items()} == dict.fromkeys(log, np.dtype(np.float32))
    # Without motion it is another filter.
    assert np.nanmax(np.abs(ScalarKalman.filter(time_s, loss_db)["loss_db"] - expected)) > 0.1


def test_one_step_at_a_time_is_the_log_in_one_call():
    time_s, loss_db = np.arange(0, 2, 0.2), np.linspace(50, 60, 10, dtype=np.float32)
    log = ScalarKalman.filter(time_s, loss_db, flow_gain_db_per_m=0)
    filter = ScalarKalman(float(loss_db[0]), flow_gain_db_per_m=0)
    for i in range(1, 10):
        filter.predict(0.0, float(np.float32(time_s[i] - time_s[i - 1])))
        assert filter.loss_db == log["predicted_db"][i]
        filter.update(float(loss_db[i]))
        assert filter.loss_db == log["loss_db"][i]
    again = pickle.loads(pickle.dumps(filter))
    assert (again.loss_db, again.variance_db2, again.params) == (
        filter.loss_db,
        filter.variance_db2,
        filter.params,
    )


def test_a_log_that_is_none_is_refused_with_its_place():
    short = np.zeros(2, np.float32)
    with pytest.raises(ValueError, match="one length.*time_s 3, loss_db 2"):
        ScalarKalman.filter(np.zeros(3), short)
    with pytest.raises(ValueError, match=r"time_s\[1\] = 0"):
        ScalarKalman.filter(np.array([1.0, 0.0]), short)
    with pytest.raises(ValueError, match="finite"):
        ScalarKalman(math.nan)
    with pytest.raises(ValueError, match="period_s"):
        ScalarKalman(50.0).predict(0.0, -1.0)


def test_a_relay_takes_off_when_it_hears_too_weakly_and_then_levels():
    relay = Node("relay", takeoff={"rise_s": 0.0, "hover_s": 0.0})
    weak = Observation(place=1, heard=[Heard(0, 80.0, place=0, flown_s=60.0)])
    decisions = [relay.decide(weak) for _ in range(50)]
    assert not decisions[0].airborne and decisions[-1].airborne
    front, back = Heard(0, 58.0, place=0), Heard.base(50.0)
    seen = Observation(place=1, heard=[front, back], tof_m=(1, 1, 1, 1), ground_speed_mps=0.0)
    for _ in range(100):
        command = relay.decide(seen)
    assert command.forward_mps > 0
    told = relay.explain(seen)
    assert told is not None and told.role == "relay" and told.stage == "flying"
    assert told.imbalance_db == pytest.approx(8.0, abs=0.1)
    assert relay.estimates.back_db == pytest.approx(50.0, abs=0.1)
    assert relay.say(seen).place == 1


def test_a_head_does_as_its_pilot_asks():
    head = Node("head", takeoff={"rise_s": 0.0, "hover_s": 0.0})
    seen = Observation(place=0, heard=[Heard.base(40.0)], pilot_mps=0.2, tof_m=(1, 1, 1, 1))
    for _ in range(5):
        command = head.decide(seen)
    assert command.forward_mps == pytest.approx(0.2)


def test_more_packets_than_a_uav_can_hear_are_refused():
    with pytest.raises(ValueError, match="9 packets; expected at most 8"):
        Observation(heard=[Heard.base(50.0)] * 9)
    with pytest.raises(ValueError, match="role: 'boss'; expected head, relay"):
        Node("boss")  # type: ignore[arg-type]


def test_two_explorers_tell_each_other_where_they_fly():
    team = [Explorer(i, 2, seed=1) for i in range(2)]
    for i, robot in enumerate(team):
        said = robot.perceive(2.0 * i, 0.0, scan_m=np.full(18, np.nan, np.float32))
        target, more = robot.announce()
        assert target.purpose == "explore"
        kinds = [message.kind for message in said + more]
        assert kinds.count("node") == 1 and kinds[-1] == "target"
        team[1 - i].hear(said + more)
    moves = [robot.resolve() for robot in team]
    assert all(move.scan for move in moves)
    assert [len(robot.nodes_m) for robot in team] == [2, 2]
    with pytest.raises(ValueError, match="sectors"):
        Explorer().perceive(0.0, 0.0, scan_m=np.zeros(3, np.float32))
    with pytest.raises(ValueError, match="robot 3 of 2"):
        Explorer(3, 2)
