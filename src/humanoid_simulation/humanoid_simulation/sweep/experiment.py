# SPDX-License-Identifier: Apache-2.0
"""Read an experiment: the YAML file that says which conditions vary, and how."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from humanoid_common.parameters import checked_value, ParameterSpec, specs_of
from humanoid_common.tables import load_table, SourceLocation, Table
from humanoid_simulation.errors import named, SimulationError
from humanoid_simulation.files import share
from humanoid_simulation.scene.loading import load_scene
from humanoid_simulation.sweep.conditions import Conditions, Run
from humanoid_simulation.sweep.sampling import Choices, Factor, GRID, METHODS, Range, Sampling
import yaml

MOST_RUNS = 1_000_000
_KEYS = ('method', 'runs', 'first_seed', 'seeds', 'falls_allowed', 'conditions')
_SEED = 'seed'


@dataclass(frozen=True)
class Experiment:
    """An experiment: its name, its runs in order, and what varies among them."""

    name: str
    runs: tuple[Run, ...]
    varied: tuple[str, ...]
    """Names of the conditions that have several values."""
    falls_allowed: float = 1.0
    """Share of runs that may fall; with more, the command fails."""


def load_experiment(name: str, overrides: Sequence[str] = ()) -> Experiment:
    """
    Load an experiment.

    Parameters
    ----------
    name
        The name of an installed experiment, or the path of a file that ends with .yaml or .yml.
    overrides
        Texts `KEY=VALUE` that replace values of the file. The value is YAML; the key is one of
        the file, or of its `conditions`, with dots between nested names.

    Raises
    ------
    SimulationError
        There is no such experiment, or it has a mistake; the message gives the line.

    """
    path = Path(name)
    if path.suffix not in ('.yaml', '.yml'):
        folder = share() / 'experiments'
        path = named('experiment', name, {each.stem: each for each in folder.glob('*.yaml')})
    return experiment_of(load_table(path), path.stem, overrides_of(overrides))


def overrides_of(texts: Sequence[str]) -> Table:
    """
    Parse texts `KEY=VALUE` as a table of the same structure as an experiment.

    Parameters
    ----------
    texts
        The texts, of which later ones win.

    Raises
    ------
    SimulationError
        A text is not of that form.

    """
    content: dict[str, Any] = {}
    for text in texts:
        key, is_given, value = text.partition('=')
        names = key.strip().split('.')
        if not is_given or not all(names):
            raise SimulationError(
                f"'--set {text}' sets nothing. Give KEY=VALUE, as in 'friction=0.6' or "
                "'walk.swing.height_m=[0.05, 0.07]'."
            )
        if names[0] not in _KEYS:
            names.insert(0, 'conditions')
        try:
            parsed = yaml.safe_load(value)
        except yaml.YAMLError as error:
            raise SimulationError(f"'--set {text}': {value} is not valid YAML.") from error
        at = content
        for each in names[:-1]:
            inner = at.setdefault(each, {})
            if not isinstance(inner, dict):
                raise SimulationError(f"'--set {text}': '{each}' has a value already.")
            at = inner
        at[names[-1]] = parsed
    return Table(content, SourceLocation('--set'))


def experiment_of(file: Table, name: str, overrides: Table) -> Experiment:
    """
    Build an experiment from the content of its file.

    Parameters
    ----------
    file
        The content of the file.
    name
        The name of the experiment.
    overrides
        Values that replace those of the file.

    Raises
    ------
    SimulationError
        There is a mistake; the message gives the line.

    """
    file.allow(*_KEYS)
    overrides.allow(*_KEYS)

    def source(key: str) -> Table:
        return overrides if overrides.has(key) else file

    method = source('method').choice('method', METHODS, GRID)
    samples = _count(source('runs'), 'runs', 1)
    sampling = Sampling(
        method,
        samples,
        source('first_seed').integer('first_seed', 0),
        _count(source('seeds'), 'seeds', 1),
    )
    factors = _factors(file, method) | _factors(overrides, method)
    if method == GRID and source('runs').has('runs'):
        place = source('runs').at('runs')
        raise place.error(
            "'runs' has no effect on a grid, which has all combinations. Remove it, set 'seeds' "
            "for several runs of each, or choose another 'method'."
        )
    if method != GRID and not source('runs').has('runs'):
        raise file.place.error(f"'method: {method}' needs 'runs', the number of draws.")
    allowed = source('falls_allowed').number('falls_allowed', 1.0)
    if not 0.0 <= allowed <= 1.0:
        place = source('falls_allowed').at('falls_allowed')
        raise place.error(
            f"'falls_allowed' is a share of the runs from 0 to 1, but is {allowed:g}."
        )
    _check_number(file, sampling, factors)
    for scene in factors['scene'].grid() if 'scene' in factors else []:
        load_scene(scene)
    runs = file.at('conditions').checked(lambda: sampling.runs(factors))
    varied = tuple(each for each, factor in factors.items() if factor.is_varied)
    return Experiment(name, tuple(runs), varied, allowed)


def _check_number(file: Table, sampling: Sampling, factors: Mapping[str, Factor]) -> None:
    """Raise TableError for more runs than anybody wants, before they are listed."""
    points = sampling.samples
    if sampling.method == GRID:
        for factor in factors.values():
            points *= len(factor.grid())
    if points * sampling.seeds > MOST_RUNS:
        raise file.place.error(
            f'{points * sampling.seeds} runs are more than {MOST_RUNS}. Give a grid fewer steps, '
            "or draw some points of it with 'method: latin_hypercube'."
        )


def _count(table: Table, name: str, default: int) -> int:
    """Read a whole number of at least one."""
    number = table.integer(name, default)
    if number < 1:
        raise table.at(name).error(f"'{name}' must be at least 1, but is 0.")
    return number


def _factors(file: Table, method: str) -> dict[str, Factor]:
    """Read the conditions of an experiment, by name and in order."""
    specs = specs_of(Conditions)
    return {
        name: _factor(table, key, specs[name], method)
        for name, table, key in _leaves(file.table('conditions'), '', [*specs])
    }


def _leaves(table: Table, prefix: str, known: Sequence[str]) -> Iterator[tuple[str, Table, str]]:
    """Yield the full name of each condition with its table and its key there."""
    inner = [name.removeprefix(prefix) for name in known if name.startswith(prefix)]
    here = dict.fromkeys(name.partition('.')[0] for name in inner if name != _SEED)
    if table.has(_SEED) and not prefix:
        raise table.at(_SEED).error(
            "seeds are not conditions: set 'first_seed' and 'seeds' of the experiment."
        )
    table.allow(*here)
    for key in table.names:
        if key in inner:
            yield f'{prefix}{key}', table, key
        else:
            yield from _leaves(table.table(key), f'{prefix}{key}.', known)


def _factor(table: Table, key: str, spec: ParameterSpec, method: str) -> Factor:
    """Read the values of a condition: one, a list, or a range."""
    value, place = table.value(key), table.at(key)
    if isinstance(value, Mapping):
        return _range(table.table(key), spec, method)
    is_list = isinstance(value, list) and not (
        spec.is_list and not any(isinstance(each, list) for each in value)
    )
    options = tuple(
        place.checked(partial(checked_value, spec, each))
        for each in (value if is_list else [value])
    )
    if not options:
        raise place.error(f'{place.key} is an empty list. Give values, or remove it.')
    if len(set(options)) < len(options):
        raise place.error(f'{place.key} has a value twice: {value}. Remove one.')
    return Choices(options)


def _range(table: Table, spec: ParameterSpec, method: str) -> Range:
    """Read a range of numbers."""
    place = table.place
    if spec.element not in (int, float) or spec.is_list:
        raise place.error(
            f'{place.key} is {spec.expected}, which has no range. Give a value, or a list.'
        )
    table.allow('from', 'to', 'steps')
    whole = spec.element is int

    def bound(name: str) -> Any:
        table.number(name)
        return table.at(name).checked(lambda: checked_value(spec, table.value(name)))

    low, high = bound('from'), bound('to')
    if not low < high:
        raise place.error(
            f"{place.key}: 'from' must be below 'to', but {low} is not below {high}."
        )
    steps = table.integer('steps', 0)
    if method == GRID and steps < 2:
        raise place.error(
            f"{place.key}: a range in a grid needs 'steps', the number of its values, from 2 on."
        )
    if method != GRID and table.has('steps'):
        raise table.at('steps').error(
            f"{place.key}: 'steps' are for a grid; 'method: {method}' draws anywhere in the range."
        )
    return Range(low, high, steps, whole)
