"""Commands from outside: worlds that stand at their decisions, and fly as the command line does when told Eq. 12."""

import pickle
import threading

import numpy as np
import pytest

import uchain

STRAIGHT = uchain.Scenario.from_name("straight")
SHORT = STRAIGHT.with_(duration_s=5)


def eq_12(seen: uchain.SeenArrays, params: uchain.LawParams) -> np.ndarray:
    """Eq. 12 in float32, in the order of the built-in law, with its guards."""
    s_d = seen.front_db - seen.back_db
    v_mps = s_d / (np.float32(3) * params.k_db_per_m) / params.decision_s
    v_mps = np.clip(v_mps, -params.v_max_mps, params.v_max_mps)
    return np.where(np.abs(s_d) <= params.tolerance_db, np.float32(0), v_mps)


def flown(env: uchain.ChainEnv, gain: float = 1.0) -> list[uchain.Summary]:
    seen = env.reset()
    while not env.done.all():
        seen = env.step(np.float32(gain) * eq_12(seen, env.params))
    return env.summaries()


@pytest.mark.parametrize("name", ["corner", "straight"])
def test_worlds_that_get_eq_12_fly_as_the_command_line_does(name: str, summary_of):
    env = uchain.ChainEnv(name, worlds=3, seed=1)
    assert env.seeds.tolist() == [1, 2, 3]
    for seed, summary in zip(env.seeds, flown(env), strict=True):
        wanted = summary_of(name, int(seed))
        assert {**wanted, **summary} == wanted
        assert summary.digest == wanted["digest"]


def test_control_a_thousandth_more_speed_is_another_flight():
    env = uchain.ChainEnv(STRAIGHT, worlds=2, seed=1)
    exact, other = flown(env), flown(env, 1.001)
    assert exact[0].digest != other[0].digest and exact[1].digest != other[1].digest
    assert [one.digest for one in flown(env)] == [one.digest for one in exact]


def test_one_world_has_the_flight_that_it_has_among_many():
    many = flown(uchain.ChainEnv(STRAIGHT.with_(duration_s=60), worlds=5, seed=3))
    one = flown(uchain.ChainEnv(STRAIGHT.with_(duration_s=60), seed=5))
    assert one[0] == many[2]


def test_what_relays_know_has_shape_worlds_relays_and_nan_where_nobody_asks():
    env = uchain.ChainEnv("corner", worlds=2)
    seen = env.reset()
    assert (env.worlds, env.relays) == (2, 3)
    assert not seen.asks.any() and np.isnan(seen.back_db).all()
    while not seen.asks.any():
        seen = env.step(np.zeros((2, 3), np.float32))
    names = [name for name in dir(seen) if not name.startswith("_") and name != "params"]
    assert all(getattr(seen, name).shape == (2, 3) for name in names)
    floats = [name for name in names if name.endswith(("_db", "_mps", "_m", "silent_s"))]
    assert len(floats) == 11
    for name in floats:
        assert getattr(seen, name).dtype == np.float32
        assert np.isnan(getattr(seen, name)[~seen.asks]).all()
        assert np.isfinite(getattr(seen, name)[seen.asks]).all()
    assert seen.uav.tolist() == [[1, 2, 3]] * 2 and seen.world.tolist() == [[0] * 3, [1] * 3]
    assert (seen.place[seen.asks] > 0).all() and (seen.place[~seen.asks] == 0).all()
    assert np.allclose(seen.time_s, env.time_s[:, None]) and np.allclose(seen.tick * 0.05, seen.time_s)


def test_arrays_are_ones_own():
    env = uchain.ChainEnv(SHORT)
    first = env.reset()
    before = first.back_db.copy()
    env.step(np.zeros((1, 3), np.float32))
    np.testing.assert_array_equal(first.back_db, before)


def test_a_step_is_a_decision_and_a_world_that_is_done_stays():
    env = uchain.ChainEnv(SHORT.with_(**{"equalize.decision_s": 0.5}))
    assert env.time_s[0] == 0.0 and not env.done.any()
    for step in range(1, 11):
        env.step(np.zeros((1, 3), np.float32))
        assert env.time_s[0] == pytest.approx(0.5 * step)
    assert env.done.all()
    with pytest.raises(uchain.UchainError, match=r"all worlds are done.*reset\(\)"):
        env.step(np.zeros((1, 3), np.float32))
    env.reset()
    assert not env.done.any()


WRONG = [
    (None, "None"),
    (0.0, "shape"),
    (np.zeros((3, 2), np.float32), r"shape \(3, 2\)"),
    (np.zeros((2, 3, 1), np.float32), r"shape \(2, 3, 1\)"),
    (np.zeros((2, 3), np.complex64), "expected float32"),
    (np.zeros((2, 3), bool), "expected float32"),
    (np.full((2, 3), "0"), "expected float32"),
    (np.full((2, 3), None), "expected float32"),
    ("text", "expected float32"),
    ([[0.0, 0.0], [0.0]], "expected float32"),
]


@pytest.mark.parametrize(("speeds", "words"), WRONG, ids=[str(i) for i in range(len(WRONG))])
def test_speeds_of_a_wrong_shape_or_dtype_are_refused_and_nothing_moves(speeds, words: str):
    env = uchain.ChainEnv(SHORT, worlds=2)
    with pytest.raises(uchain.LawError, match=words):
        env.step(speeds)
    assert (env.time_s == 0).all()


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e39])
def test_a_speed_that_is_no_number_is_refused_where_a_relay_asks_and_nowhere_else(bad: float):
    env = uchain.ChainEnv("straight", worlds=2)
    seen = env.reset()
    while not seen.asks[1].any():
        seen = env.step(np.full((2, 3), bad) if not seen.asks.any() else np.zeros((2, 3)))
    before = env.time_s
    speeds = np.zeros((2, 3))
    relay = int(np.flatnonzero(seen.asks[1])[0])
    speeds[1, relay] = bad
    tick = int(seen.tick[1, relay])
    with pytest.raises(uchain.LawError, match=rf"forward_mps\[1, {relay}\] = .*tick {tick} .*UAV {relay + 1}"):
        env.step(speeds)
    np.testing.assert_array_equal(env.time_s, before)


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int64, np.uint8, ">f4"])
def test_every_kind_of_real_number_is_taken(dtype):
    env = uchain.ChainEnv(SHORT, worlds=2)
    env.step(np.zeros((2, 3), dtype))
    env.step(np.zeros((2, 3), dtype, order="F"))
    env.step(np.zeros((4, 6), dtype)[::2, ::2])
    env.step([[0, 0, 0], [0, 0.0, 0]])
    assert env.time_s[0] == pytest.approx(0.8)


def test_a_pilot_steers_from_the_next_tick_on():
    def reach_m(pilot_mps) -> np.ndarray:
        env = uchain.ChainEnv(STRAIGHT.with_(duration_s=20), worlds=2)
        for step in range(100):
            env.step(np.zeros((2, 3)), pilot_mps if step == 0 else None)
        return env.truth().head_reach_m

    by_script = reach_m(None)
    np.testing.assert_array_equal(reach_m([np.nan, np.nan]), by_script)
    hovering = reach_m(0.0)
    assert (hovering < 1.0).all() and (by_script > 2.0).all()
    one = reach_m([0.0, np.nan])
    assert one[0] == hovering[0] and one[1] == by_script[1]


@pytest.mark.parametrize("pilot", [1.5, -2, np.inf, [0.0], [0.0, 3.0], "fast", 1j, True, [[0.0, 0.0]]])
def test_what_no_pilot_may_ask_for_is_refused_and_nobody_is_steered(pilot):
    env = uchain.ChainEnv(SHORT, worlds=2)
    with pytest.raises(ValueError, match="pilot_mps"):
        env.step(np.zeros((2, 3)), pilot)
    assert (env.time_s == 0).all()
    for _ in range(25):
        env.step(np.zeros((2, 3)))
    other = uchain.ChainEnv(SHORT, worlds=2)
    for _ in range(25):
        other.step(np.zeros((2, 3)))
    assert env.summaries() == other.summaries()


def test_a_wall_is_followed_with_a_pilot_only():
    env = uchain.ChainEnv(SHORT)
    with pytest.raises(ValueError, match="follow"):
        env.step(np.zeros((1, 3)), follow="left")
    with pytest.raises(ValueError, match="centre"):
        env.step(np.zeros((1, 3)), 0.1, "up")
    env.step(np.zeros((1, 3)), 0.1, "left")


def test_the_truth_is_told_under_its_name_only():
    env = uchain.ChainEnv("corner", worlds=2, seed=4)
    truth = env.truth()
    assert truth.x_m.shape == (2, 4) and not truth.airborne.any() and np.isnan(truth.true_db).all()
    assert np.allclose(truth.x_m[0], [0.75, 0.5, 0.25, 0.0])
    seen = env.reset()
    while not seen.asks.any():
        seen = env.step(np.zeros((2, 3)))
    truth = env.truth()
    assert truth.airborne.any(axis=1).all() and np.isfinite(truth.true_db).any()
    assert not {"x_m", "y_m", "true_db", "airborne"} & set(dir(seen))


def test_an_environment_is_reset_to_its_seeds_or_to_others():
    env = uchain.ChainEnv(STRAIGHT.with_(duration_s=30), worlds=2, seed=8)
    first = flown(env)
    assert [one["seed"] for one in first] == [8, 9]
    env.reset(seed=100)
    assert env.seeds.tolist() == [100, 101]
    env.reset(seed=8)
    assert flown(env) == first


@pytest.mark.parametrize(
    ("what", "worlds", "seed", "error"),
    [
        ("lab", 1, 0, "which has no relays"),
        (SHORT, 0, 0, "worlds = 0"),
        (SHORT, -1, 0, "worlds = -1"),
        (SHORT, 10**9, 0, "from 0 to 4096"),
        (SHORT, True, 0, "worlds = True"),
        (SHORT, 1.5, 0, "worlds = 1.5"),
        (SHORT, 1, -1, "seed = -1"),
        (SHORT, 2, 2**64 - 1, "seed"),
        (SHORT, 1, None, None),
    ],
)
def test_arguments_are_checked(what, worlds, seed, error):
    if error is None:
        assert uchain.ChainEnv(what, worlds, seed).seeds[0] == 0
        return
    with pytest.raises(ValueError, match=error):
        uchain.ChainEnv(what, worlds, seed)


def test_an_environment_is_pickled_before_its_first_step_and_not_after():
    env = uchain.ChainEnv(SHORT, worlds=2, seed=3)
    again = pickle.loads(pickle.dumps(env))
    assert (again.worlds, again.seeds.tolist(), again.scenario) == (2, [3, 4], SHORT)
    env.step(np.zeros((2, 3)))
    with pytest.raises(TypeError, match=r"under way cannot be pickled: reset\(\)"):
        pickle.dumps(env)
    env.reset()
    pickle.dumps(env)


def test_what_it_shows_is_pickled():
    env = uchain.ChainEnv(SHORT, worlds=2)
    seen, truth = env.reset(), env.truth()
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(seen)).uav, seen.uav)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(truth)).x_m, truth.x_m)
    params = pickle.loads(pickle.dumps(env.params))
    assert params.k_db_per_m == env.params.k_db_per_m and params.decision_s == np.float32(0.2)


def test_threads_step_environments_of_their_own_and_share_one():
    wanted = flown(uchain.ChainEnv(STRAIGHT.with_(duration_s=20), worlds=4))
    results: list[list[uchain.Summary]] = []
    threads = [
        threading.Thread(
            target=lambda: results.append(flown(uchain.ChainEnv(STRAIGHT.with_(duration_s=20), worlds=4)))
        )
        for _ in range(4)
    ]
    shared = uchain.ChainEnv(STRAIGHT.with_(duration_s=5), worlds=4)
    steppers = [threading.Thread(target=lambda: [shared.step(np.zeros((4, 3))) for _ in range(5)]) for _ in range(4)]
    for thread in threads + steppers:
        thread.start()
    for thread in threads + steppers:
        thread.join()
    assert results == [wanted] * 4
    assert np.allclose(shared.time_s, 4.0)
