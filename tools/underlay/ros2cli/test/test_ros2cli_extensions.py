# SPDX-License-Identifier: Apache-2.0
"""Tests of the hidden commands that list what `ros2` consists of."""

from collections.abc import Callable

import pytest
from ros2cli.cli import COMMANDS, main
from ros2cli.commands import TopicCommand
from ros2cli.entry import Entry
from ros2cli.extensions import extension_points

GROUPS = [
    'ros2action.verb',
    'ros2bag.verb',
    'ros2cli.command',
    'ros2component.verb',
    'ros2controlcli.verb',
    'ros2daemon.verb',
    'ros2doctor.checks',
    'ros2doctor.report',
    'ros2doctor.verb',
    'ros2interface.verb',
    'ros2lifecycle.verb',
    'ros2multicast.verb',
    'ros2node.verb',
    'ros2param.verb',
    'ros2pkg.verb',
    'ros2service.verb',
    'ros2topic.verb',
]
OTHERS = {
    'ros2topic.verb': {
        'broken': Entry('no_such_module:Verb', ''),
        'relay': Entry('ros2topic.verb.pub:PubVerb', ''),
    }
}


@pytest.fixture(autouse=True)
def others(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let another package have two verbs of `ros2 topic`, one of which cannot be imported."""
    monkeypatch.setattr('ros2cli.extensions.entries_of_group', lambda group: OTHERS.get(group, {}))


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., list[str]]:
    """Return a function that runs a command without errors, and returns its lines."""

    def call(*words: str) -> list[str]:
        assert main(words) == 0
        captured = capsys.readouterr()
        assert captured.err == ''
        return captured.out.splitlines()

    return call


def test_extension_points_are_sorted(run: Callable[..., list[str]]) -> None:
    """The groups of entry points come one a line."""
    assert run('extension_points') == GROUPS
    lines = run('extension_points', '--verbose')
    assert lines[::2] == GROUPS
    assert lines[-1] == f'  {len(TopicCommand.VERBS)} here, 2 from other packages'


def test_extensions_stand_below_their_group(run: Callable[..., list[str]]) -> None:
    """What other packages add is among the rest, unless it cannot be imported."""
    lines = run('extensions')
    assert [line for line in lines if not line.startswith(' ')] == GROUPS
    verbs = sorted([*TopicCommand.VERBS, 'relay'])
    start = lines.index('ros2topic.verb') + 1
    assert lines[start:] == [f'  {verb}' for verb in verbs]


def test_all_extensions_include_broken_ones(run: Callable[..., list[str]]) -> None:
    """A broken extension is shown with the reason when all are asked for."""
    lines = run('extensions', '-a', '-v')
    broken = lines.index("  - broken: ModuleNotFoundError: No module named 'no_such_module'")
    assert lines[broken + 1] == '    no_such_module:Verb'


def test_hidden_commands_are_choices(capsys: pytest.CaptureFixture[str]) -> None:
    """The help does not show them; the list of choices does."""
    assert {name for name, entry in COMMANDS.items() if entry.hidden} == {
        'extension_points',
        'extensions',
    }
    main(['--help'])
    assert 'extension_points' not in capsys.readouterr().out
    main(['nope'])
    assert "'extension_points', 'extensions', " in capsys.readouterr().err


def test_all_own_extensions_can_be_imported() -> None:
    """No row of a table names a class that does not exist."""
    tables = extension_points().values()
    assert all(entry.create() for table in tables for entry in table.values())
