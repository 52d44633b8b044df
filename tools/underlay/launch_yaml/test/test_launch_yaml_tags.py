# SPDX-License-Identifier: Apache-2.0
"""The tags of launch in YAML."""

from __future__ import annotations

from collections.abc import Callable

import pytest

Run = Callable[..., list[str]]


def logged(lines: list[str]) -> list[str]:
    """Return what was logged for the user."""
    mark = '[INFO] [launch.user]: '
    return [line.replace(mark, '') for line in lines if line.startswith(mark)]


@pytest.mark.parametrize(
    'content, texts',
    [
        ('- arg: {name: a, default: "1"}\n- log: {message: "$(var a)"}', ['1']),
        ('- let: {name: a, value: "$(env NONE x)"}\n- log: {message: "$(var a)"}', ['x']),
        ('- log: {message: a, if: "false"}\n- log: {message: b, unless: "false"}', ['b']),
        (
            '- group:\n  - let: {name: a, value: "1"}\n  - log: {message: "$(var a)"}\n'
            '- log: {message: "$(var a gone)"}',
            ['1', 'gone'],
        ),
        (
            '- group:\n    scoped: false\n    children:\n    - let: {name: a, value: "1"}\n'
            '- log: {message: "$(var a)"}',
            ['1'],
        ),
        (
            '- let: {name: a, value: "1"}\n'
            '- group:\n    forwarding: false\n    keep:\n    - {name: b, value: "$(var a)"}\n'
            '    children:\n    - log: {message: "$(var a gone) $(var b)"}\n',
            ['gone 1'],
        ),
        (
            '- set_env: {name: A, value: "1"}\n- append_env: {name: A, value: "2"}\n'
            '- log: {message: "$(env A)"}\n- unset_env: {name: A}\n'
            '- log: {message: "$(env A gone)"}',
            ['1:2', 'gone'],
        ),
        (
            '- let: {name: a, value: "1"}\n- reset:\n    keep:\n    - {name: b, value: "2"}\n'
            '- log: {message: "$(var a gone) $(var b)"}\n- reset_env:',
            ['gone 2'],
        ),
        (
            '- timer:\n    period: 0.1\n    children:\n    - log: {message: later}\n'
            '- log: {message: now}',
            ['now', 'later'],
        ),
        ('- timer:\n    period: "0"\n    children:\n    - log: {message: x}', ['x']),
        ('- shutdown: {reason: enough}\n- log: {message: "yes"}', ['yes']),
    ],
)
def test_tags(content: str, texts: list[str], run: Run) -> None:
    """Each tag does what it says."""
    assert logged(run(f'launch:\n{content}\n')) == texts


def test_choices(run: Run) -> None:
    """An argument may have choices."""
    lines = run('launch:\n- arg:\n    name: a\n    choice:\n    - {value: x}\n', a='y')
    assert any("is not valid. Valid options are: ['x']" in line for line in lines)


@pytest.mark.parametrize('key', ['arg', 'let'])
def test_include(key: str, run: Run, write: Callable[[str, str], str]) -> None:
    """An include passes arguments."""
    write('child.launch.yml', 'launch:\n- arg: {name: a}\n- log: {message: "$(var a)"}\n')
    lines = run(
        'launch:\n- include:\n    file: "$(dirname)/child.launch.yml"\n'
        f'    {key}:\n    - {{name: a, value: hello}}\n'
    )
    assert logged(lines) == ['hello']


def test_executable(run: Run) -> None:
    """A command is run with its attributes and variables."""
    lines = run(
        'launch:\n- executable:\n    cmd: sh -c "echo \\$A"\n    output: screen\n    name: me\n'
        '    env:\n    - {name: A, value: hello}\n    respawn: false\n    shell: false\n'
    )
    assert [line for line in lines if line.startswith('[me-') and line.endswith('] hello')]


@pytest.mark.parametrize('name', ['a.yaml', 'a.yml', 'a.launch', 'a', 'a.launch.yaml'])
def test_names_of_files(name: str, run: Run) -> None:
    """A file is read as YAML whatever its name."""
    assert logged(run('launch:\n- log: {message: x}\n', name)) == ['x']


def test_deprecated(run: Run) -> None:
    """A launch file may say that it should not be used."""
    lines = run('launch:\n  deprecated: use another\n  children:\n  - log: {message: x}\n')
    assert lines[0].endswith('test.launch.yaml] is deprecated: use another')
    assert logged(lines) == ['x']


def test_anchors(run: Run) -> None:
    """What YAML has for repetition can be used."""
    lines = run(
        'launch:\n- log: &text {message: x}\n- log: *text\n- log: {<<: *text, if: "false"}\n'
    )
    assert logged(lines) == ['x', 'x']
