# SPDX-License-Identifier: Apache-2.0
"""Check how an experiment becomes a list of runs, and what is wrong with others."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_common.tables import load_table, table_of
from humanoid_simulation.sweep.conditions import Conditions, conditions_of, values_to_store
from humanoid_simulation.sweep.experiment import Experiment, experiment_of, overrides_of
import pytest

EXPERIMENTS = Path(__file__).parents[1] / 'experiments'


def experiment(text: str, *overrides: str) -> Experiment:
    """Read an experiment."""
    return experiment_of(table_of(text, 'x.yaml'), 'x', overrides_of(overrides))


def values(text: str, *names: str) -> list[tuple[object, ...]]:
    """Return some conditions of all runs."""
    runs = (run.conditions for run in experiment(text).runs)
    return [tuple(getattr(conditions, name) for name in names) for conditions in runs]


def test_a_grid_has_all_combinations() -> None:
    """In order, each with the same seeds."""
    text = """
        first_seed: 7
        seeds: 2
        conditions:
          friction: [0.5, 1]
          latency_periods: {from: 0, to: 4, steps: 3}
    """
    expected = [(f, old, s) for f in (0.5, 1.0) for old in (0, 2, 4) for s in (7, 8)]
    assert values(text, 'friction', 'latency_periods', 'seed') == expected
    assert experiment(text).varied == ('friction', 'latency_periods')


def test_more_random_runs_keep_the_first_ones() -> None:
    """So that those that are finished are not done again."""
    text = 'method: random\nruns: 3\nconditions: {friction: {from: 0.5, to: 1}, hands: [true, no]}'
    few, many = experiment(text), experiment(text, 'runs=5')
    assert many.runs[:3] == few.runs and len({run.key for run in many.runs}) == 5
    assert all(0.5 <= run.conditions.friction <= 1.0 for run in many.runs)


def test_a_latin_hypercube_covers_each_range() -> None:
    """Each of as many slices as there are runs is drawn from once; lists and whole ones, too."""
    text = """
        method: latin_hypercube
        runs: 8
        conditions:
          friction: {from: 0.4, to: 1.2}
          latency_periods: {from: 0, to: 3}
          self_collision: [arms, all]
    """
    rows = values(text, 'friction', 'latency_periods', 'self_collision')
    frictions, latencies, collisions = zip(*rows)
    assert sorted(int((each - 0.4) / 0.1) for each in frictions) == [*range(8)]
    assert sorted(latencies) == [0, 0, 1, 1, 2, 2, 3, 3]
    assert collisions.count('all') == 4
    assert values(text, 'friction') == values(text, 'friction')


def test_the_soak_is_that_of_the_documentation() -> None:
    """The first rows of its table in performance.md."""
    soak = experiment_of(load_table(EXPERIMENTS / 'soak.yaml'), 'soak', overrides_of([]))
    rows = [
        (round(each.friction, 2), round(100 * each.mass.torso - 100), each.latency_periods)
        for each in (run.conditions for run in soak.runs)
    ]
    assert len(rows) == 20 and rows[:3] == [(1.03, 2, 0), (0.70, 4, 1), (1.04, 14, 0)]
    assert {run.conditions.seconds for run in soak.runs} == {60.0}


@pytest.mark.parametrize('path', EXPERIMENTS.glob('*.yaml'), ids=lambda path: path.stem)
def test_installed_experiments_are_valid(path: Path) -> None:
    """Each can be read, and varies something."""
    assert experiment_of(load_table(path), path.stem, overrides_of([])).varied


def test_values_can_be_replaced() -> None:
    """Of the file and of its conditions, also nested ones and new ones."""
    text = 'conditions:\n  friction: [0.5, 1.0]\n  walk: {swing: {height_m: 0.05}}'
    replaced = experiment(text, 'friction=0.7', 'walk.swing.height_m=[0.06, 0.07]', 'seeds=2')
    found = {
        (run.conditions.friction, run.conditions.walk.swing.height_m) for run in replaced.runs
    }
    assert found == {(0.7, 0.06), (0.7, 0.07)} and len(replaced.runs) == 4


def test_a_list_parameter_is_one_value() -> None:
    """A list of lists varies it."""
    one = experiment('conditions: {walk: {step_adjustment: {hurry_rates: [1.0, 1.5]}}}')
    assert one.runs[0].conditions.walk.step_adjustment.hurry_rates == (1.0, 1.5)
    two = experiment('conditions: {walk: {step_adjustment: {hurry_rates: [[1.0], [1.0, 2.0]]}}}')
    assert len(two.runs) == 2


@pytest.mark.parametrize(
    ('text', 'sentence'),
    [
        ('conditons: {}', "x.yaml, line 1: the file has an unknown key 'conditons'. Did you mean"),
        ('conditions:\n  fricton: 1', "line 2: conditions has an unknown key 'fricton'. Did you"),
        ('conditions: {walk: {swing: {hight_m: 1}}}', "'hight_m'. Did you mean 'height_m'?"),
        ('conditions: {friction: 9}', 'must be between 0.05 and 5.0'),
        ('conditions: {friction: rough}', 'must be a number'),
        ('conditions: {friction: }', 'must be a number'),
        ('conditions: {friction: []}', 'conditions.friction is an empty list'),
        ('conditions: {friction: [1, 1.0]}', 'conditions.friction has a value twice'),
        ('conditions: {commands: randm}', "Did you mean 'random'?"),
        ('conditions: {scene: flatt}', "There is no scene 'flatt'. Did you mean 'flat'?"),
        ('conditions: {scene: none.yaml}', 'none.yaml'),
        ('conditions: {scene: {from: 1, to: 2}}', 'has no range'),
        ('conditions: {seed: 3}', "set 'first_seed' and 'seeds'"),
        ('conditions: {load_kg: 1}', "'load_kg' needs 'hands: true'"),
        ('conditions: {commands: random, forward_m_s: 0.1}', "no effect with 'commands: random'"),
        ('conditions: {push_every_s: 0.05}', "'push_every_s' is 0.05, but a push takes 0.1 s"),
        (
            'conditions: {push_ns: 5, push_at_s: 20}',
            "'push_at_s' is 20, but a run ends after 20 s",
        ),
        ('conditions: {friction: {from: 1, to: 0.5, steps: 2}}', "'from' must be below 'to'"),
        ('conditions: {friction: {from: 0.5, to: 1}}', "needs 'steps'"),
        ('conditions: {friction: {from: 0.5, till: 1}}', "'till'"),
        ('method: grd', "Did you mean 'grid'?"),
        ('method: random', "needs 'runs'"),
        ('method: random\nruns: 0', "'runs' must be at least 1"),
        ('runs: 3', "'runs' has no effect on a grid"),
        ('method: random\nruns: 1\nconditions: {friction: {from: 1, to: 2, steps: 3}}', 'a grid'),
        ('falls_allowed: 5', 'from 0 to 1, but is 5'),
        ('seeds: 2000000', 'are more than 1000000'),
    ],
)
def test_mistakes(text: str, sentence: str) -> None:
    """Each is named in a sentence."""
    with pytest.raises(UserError) as caught:
        experiment(text)
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ('override', 'sentence'),
    [
        ('friction', "'--set friction' sets nothing"),
        ('=1', "'--set =1' sets nothing"),
        ('friction=[', 'is not valid YAML'),
        ('frction=1', "--set: conditions has an unknown key 'frction'. Did you mean 'friction'?"),
    ],
)
def test_mistakes_of_the_command_line(override: str, sentence: str) -> None:
    """They are said like those of a file."""
    with pytest.raises(UserError) as caught:
        experiment('conditions: {}', override)
    assert sentence in str(caught.value)


def test_the_key_is_that_of_the_conditions(tmp_path: Path) -> None:
    """Any other value makes another key; the name of a scene's file does not, its content does."""
    keys = {
        conditions_of(each).digest
        for each in ({}, {'seed': 1}, {'mass.head': 1.1}, {'walk.timing.swing_s': 0.3})
    }
    assert len(keys) == 4
    for name, content in (('a', 'floor: {}'), ('b', 'floor: {}'), ('c', 'floor: {friction: 2}')):
        (tmp_path / f'{name}.yaml').write_text(content)
    a, b, c = (Conditions(scene=str(tmp_path / f'{name}.yaml')).digest for name in 'abc')
    assert a == b != c


def test_conditions_survive_the_record() -> None:
    """Parameters of the walk are stored only where they differ."""
    conditions = conditions_of({'friction': 0.7, 'walk.swing.height_m': 0.06, 'seed': 3})
    stored = values_to_store(conditions)
    assert conditions_of(stored) == conditions
    assert [name for name in stored if name.startswith('walk.')] == ['walk.swing.height_m']
