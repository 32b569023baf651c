"""How long a run is said to take follows from what it consists of; nothing here is timed."""

import pytest
from poinsot.adapters import registry
from poinsot.adapters.runner import Request
from poinsot.scenarios.registry import scenes, select

from poinsot import estimate as module
from poinsot.estimate import Estimate, estimate, recorded, spoken, work
from poinsot.plan import Extent, in_turn, plan, to_time

PULSE = recorded()["pulse"]
ENGINE = """
from poinsot.adapters.engine import Scheme

class Own:
    name = "own"
    schemes = (Scheme("Euler", 1, "own", {}), Scheme("fourth", 4, "own4", {}))
    features = frozenset({"free", "ball", "hinge", "slide", "gravity", "spring", "tree", "force", "contact"})
    settings = {}
    version = staticmethod(lambda: "1")
    build = step = state = readback = acceleration = model_text = close = None
"""


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """An engine of the user's own, of which no rates are on record."""
    path = tmp_path_factory.mktemp("own") / "own.py"
    path.write_text(ENGINE)
    return f"{path}:Own"


def laid(own, extent=Extent.WHOLE, *names):
    """A plan of that engine alone."""
    return plan(select(list(names)), [own], [], [], extent)


def seconds(asked, workers=2, cores=2, timing=True, pulse=PULSE):
    """Expected seconds."""
    return estimate(asked, workers, cores, timing, pulse).seconds


def test_every_extent_takes_longer_than_the_one_before(own):
    every = [seconds(laid(own, extent)) for extent in (Extent.QUICK, Extent.USUAL, Extent.WHOLE, Extent.FULL)]
    assert every == sorted(every)
    assert len(set(every)) == 4


def test_what_is_not_done_is_not_expected(own):
    quick = estimate(laid(own, Extent.QUICK), 2, 2, False, PULSE)
    assert set(quick.phases) == {"simulating", "judging", "report"}
    assert set(estimate(laid(own, Extent.FULL), 2, 2, True, PULSE).phases) == {
        *quick.phases, "timing", "steps beyond the ladders",
    }  # fmt: skip


def test_workers_share_cells_as_far_as_there_are_cores_and_never_the_timing(own):
    asked = laid(own)
    one, two, many = (estimate(asked, workers, 2, True, PULSE).phases for workers in (1, 2, 8))
    start = recorded()["start"]
    for phase in ("simulating", "judging"):
        assert sum(one[phase]) - start == pytest.approx(2 * (sum(two[phase]) - start))
    assert one["timing"] == two["timing"]
    assert two == many


def test_a_slower_machine_takes_longer_by_as_much(own):
    assert seconds(laid(own), pulse=4 * PULSE) == pytest.approx(2 * seconds(laid(own)))


def test_pieces_come_in_the_order_of_the_run(own):
    asked = laid(own, Extent.WHOLE, "heavy_top[moderate]")
    expected = estimate(asked, 1, 1, True, PULSE)
    whole = [work(request).whole for request in in_turn(asked)]
    assert expected.phases["simulating"][1:] == pytest.approx(whole[1:])
    assert expected.cells == len(whole) == len(expected.phases["simulating"])
    assert len(expected.phases["timing"]) == len(to_time(asked, asked.records))


def test_a_cell_takes_what_its_steps_and_repeats_take(own):
    coarse, fine = (work(Request("heavy_top[moderate]", own, "Euler", dt)) for dt in (1e-3, 1e-4))
    steps = 9 * scenes()["heavy_top[moderate]"].duration / 1e-3
    assert fine.whole - coarse.whole == pytest.approx(steps * coarse.step)
    twice, asked = (
        work(Request("heavy_top[moderate]", own, "Euler", 1e-3, **more))
        for more in ({"repeats": 2}, {"asked": True})
    )
    assert min(twice.whole, asked.whole) > coarse.whole


def test_timing_builds_anew_where_a_repeat_does_not_fit_into_the_run_or_bodies_touch():
    work_of = module.Work(step=1e-6, built=1.0, whole=0.0)
    top, hoop = scenes()["heavy_top[moderate]"], scenes()["rolling[hoop]"]
    steps = [top.samples * top.steps_per_sample(dt) for dt in (5e-3, 1e-5)]
    assert steps[0] * 1e-6 < module.SPAN < steps[1] * 1e-6 / 10
    assert module.timing(top, 5e-3, work_of) == pytest.approx(11 + 11 * steps[0] * 1e-6)
    assert module.timing(top, 1e-5, work_of) == pytest.approx(2 + 11 * module.SPAN)
    assert module.timing(hoop, 1e-6, work_of) == pytest.approx(11 + 11 * module.SPAN)


def test_forces_and_contacts_cost_more():
    plain, force, contact = (
        work(Request(name, "pinocchio", "semi-implicit Euler", 1e-3)).step
        for name in ("heavy_top[moderate]", "two_body[spring]", "rolling[hoop]")
    )
    assert plain < force < contact


def test_what_no_rates_are_of_is_the_mean_of_what_there_is(own):
    steps = [rates["plain"] for rates in recorded()["step"].values()]
    assert work(Request("heavy_top[moderate]", own, "Euler", 1e-3)).step == pytest.approx(
        sum(steps) / len(steps)
    )


@pytest.mark.parametrize("name", ["mujoco", "pybullet", "pinocchio"])
def test_rates_are_of_every_scheme_there_is(name):
    pytest.importorskip("pinocchio" if name == "pinocchio" else name)
    assert name in recorded()["cell"]
    for scheme in registry.load(name).schemes:
        assert f"{name} {scheme.name}" in recorded()["step"]


def test_what_is_left_goes_down_to_nothing():
    expected = Estimate(4, 2, {"simulating": [4.0, 3.0, 2.0, 1.0], "judging": [10.0]}, PULSE)
    on_time = [expected.left("simulating", done, elapsed) for done, elapsed in ((0, 0), (1, 4), (4, 10))]
    assert on_time == pytest.approx([20, 16, 10])
    assert expected.left("judging", 1, 20) == 0
    # What was to take 10 s took 20: the rest is expected to take nearly twice as long too.
    assert expected.left("simulating", 4, 20) == pytest.approx(10 * 22 / 12)
    assert expected.left("what was not foreseen", 1, 20) == 0


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (0.1, "5 s"),
        (31, "35 s"),
        (94, "95 s"),
        (96, "1 min 40 s"),
        (119, "2 min"),
        (601, "10 min"),
        (3e4, "500 min"),
    ],
)
def test_times_are_said_no_more_exactly_than_they_are_known(given, said):
    assert spoken(given) == said


def test_the_line_before_a_run(own):
    asked = laid(own, Extent.WHOLE, "heavy_top[moderate]")
    said = str(estimate(asked, 1, 2, True, PULSE, others=1))
    assert said.startswith("11 cells, about ")
    assert said.endswith("with 1 worker on this machine")
    crowded = str(estimate(asked, 2, 2, False, PULSE, others=4))
    assert "while others keep it as busy as now" in crowded


def test_others_take_their_part_of_the_cores_there_are(own):
    asked = laid(own)
    for others, cores, of_many, of_one in ((0, 2, 1, 1), (1, 2, 1.5, 1), (4, 2, 3, 2.5), (4, 8, 1, 1)):
        found = estimate(asked, 2, cores, True, PULSE, others)
        alone = sum(sum(found.phases[phase]) for phase in ("timing", "report"))
        many = found.seconds - alone
        assert found.crowding * found.seconds == pytest.approx(of_many * many + of_one * alone)


def test_a_plan_of_nothing_takes_next_to_nothing():
    nothing = plan([], [], [], [])
    assert seconds(nothing) == pytest.approx(module.recorded()["report"]["start"])
