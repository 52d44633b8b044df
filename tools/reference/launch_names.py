# SPDX-License-Identifier: Apache-2.0
"""Describe the names that launch files use, as the code has them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from importlib import import_module
import inspect
from typing import Any

PACKAGES = (
    'launch',
    'launch.actions',
    'launch.conditions',
    'launch.substitutions',
    'launch.event_handlers',
    'launch.events',
    'launch.events.process',
    'launch.launch_description_sources',
    'launch_ros.actions',
    'launch_ros.descriptions',
    'launch_ros.substitutions',
    'launch_ros.event_handlers',
    'launch_ros.events',
    'launch_ros.events.lifecycle',
)


def lines() -> Iterator[str]:
    """Yield the lines of the page."""
    tags = _written_names()
    for package in PACKAGES:
        yield f'## {package}\n'
        yield '| name | in XML and YAML | arguments | |'
        yield '|---|---|---|---|'
        module = import_module(package)
        for name in sorted(module.__all__):
            value = getattr(module, name)
            if inspect.isclass(value):
                yield _row(name, value, tags.get(value, []))
        yield ''


def _row(name: str, value: type, tags: list[str]) -> str:
    summary = (inspect.getdoc(value) or '').partition('\n')[0]
    arguments = ', '.join(f'`{each}`' for each in _arguments(value))
    cells = [f'`{name}`', ', '.join(tags), arguments, summary]
    return f'| {" | ".join(cells)} |'


def _arguments(value: type) -> Iterator[str]:
    """Yield the arguments of a class and, where it passes others on, those of its bases."""
    seen = set()
    for each in value.__mro__:
        if '__init__' not in vars(each) or each is object:
            continue
        parameters = list(inspect.signature(each.__init__).parameters.values())[1:]  # type: ignore[misc]
        passed_on = False
        for parameter in parameters:
            if parameter.kind is parameter.VAR_KEYWORD:
                passed_on = True
            elif parameter.name not in seen and not _is_given_by(value, each, parameter):
                seen.add(parameter.name)
                yield _text(parameter)
        if not passed_on:
            return


def _is_given_by(value: type, base: type, parameter: inspect.Parameter) -> bool:
    """Return whether a class makes what its base wants to know from its own arguments."""
    return parameter.name == 'process_description' and value is not base


def _text(parameter: inspect.Parameter) -> str:
    """Return the name of an argument; `=` marks one that may be left out."""
    stars = '*' if parameter.kind is parameter.VAR_POSITIONAL else ''
    return f'{stars}{parameter.name}' + ('' if parameter.default is parameter.empty else '=')


def _written_names() -> dict[Any, list[str]]:
    """Return how the classes are written in launch files that are not in Python."""
    found: dict[Any, list[str]] = defaultdict(list)
    for package in ('launch.frontend.expose', 'launch_ros.frontend_names'):
        tables = import_module(package)
        for names, form in ((tables.ACTIONS, '`{}`'), (tables.SUBSTITUTIONS, '`$({})`')):
            for name, target in sorted(names.items()):
                module, _, attribute = target.partition(':')
                found[getattr(import_module(module), attribute)].append(form.format(name))
    return found
