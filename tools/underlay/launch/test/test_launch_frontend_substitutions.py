# SPDX-License-Identifier: Apache-2.0
"""The substitutions as launch files write them."""

from __future__ import annotations

import os
from pathlib import Path
import re
import shutil

from launch import LaunchContext
from launch.frontend.expose import known_substitutions, load, SUBSTITUTIONS
from launch.frontend.parse_substitution import parse_substitution
from launch.utilities import perform_substitutions
import pytest

EXAMPLES = [
    ('$(var robot)', 'r1'),
    ('$(var nobody default)', 'default'),
    ('$(env FRONTEND_TEST)', 'value'),
    ('$(env FRONTEND_MISSING default)', 'default'),
    ("$(env FRONTEND_MISSING '')", ''),
    ("$(eval '2 * 3')", '6'),
    ("$(eval 'pi > 3')", 'True'),
    ('$(eval \'sys.maxsize > os.path.sep.count("x")\' sys,os)', 'True'),
    ("$(command 'echo $(var robot)')", 'r1\n'),
    ('$(command \'sh -c "echo x; echo y >&2"\' ignore)', 'x\n'),
    ('$(dirname)', '/a'),
    ('$(filename)', '/a/b.launch.xml'),
    ('$(find-exec sh)', shutil.which('sh')),
    ('$(file-content $(env FRONTEND_FILE))', 'in the file'),
    ('$(not true)', 'false'),
    ('$(not off)', 'true'),
    ('$(and true false)', 'false'),
    ('$(or yes 0)', 'true'),
    ('$(any false false true)', 'true'),
    ('$(all true true false)', 'false'),
    ('$(all true)', 'true'),
    ('$(equals 1 1.0)', 'true'),
    ('$(equals $(var robot) r2)', 'false'),
    ('$(not-equals a b)', 'true'),
    ('$(if true a b)', 'a'),
    ('$(if $(equals x y) a b)', 'b'),
    ('$(if false a)', ''),
]


@pytest.fixture
def robot(context: LaunchContext, tmp_path: Path) -> LaunchContext:
    """Return a context with a launch configuration, a launch file and an environment."""
    context.launch_configurations['robot'] = 'r1'
    context.extend_locals(
        {
            'current_launch_file_path': '/a/b.launch.xml',
            'current_launch_file_directory': '/a',
        }
    )
    os.environ['FRONTEND_TEST'] = 'value'
    (tmp_path / 'text').write_text('in the file')
    os.environ['FRONTEND_FILE'] = str(tmp_path / 'text')
    return context


@pytest.mark.parametrize('text, result', EXAMPLES)
def test_substitution(text: str, result: str, robot: LaunchContext) -> None:
    """A substitution gives what it stands for."""
    assert perform_substitutions(robot, parse_substitution(text)) == result


def test_anonymous_name(robot: LaunchContext) -> None:
    """The same name becomes the same unique name."""
    first, second = (
        perform_substitutions(robot, parse_substitution('$(anon node)')) for _ in range(2)
    )
    assert first == second
    assert first.startswith('node_')


@pytest.mark.parametrize('name', ['log_dir', 'launch_log_dir'])
def test_log_folder(name: str, robot: LaunchContext) -> None:
    """Both names stand for the folder of the log files."""
    folder = perform_substitutions(robot, parse_substitution(f'$({name})'))
    assert folder.startswith(os.environ['ROS_LOG_DIR'])


def test_every_known_substitution_is_tested() -> None:
    """Each place in the table has a class with parse(), and each name of launch an example."""
    for place in known_substitutions().values():
        assert callable(load(place).parse)
    shown = {re.split('[ )]', text[2:])[0] for text, _ in EXAMPLES}
    assert shown | {'anon', 'log_dir', 'launch_log_dir'} == set(SUBSTITUTIONS)
