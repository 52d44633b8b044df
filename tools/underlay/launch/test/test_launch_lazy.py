# SPDX-License-Identifier: Apache-2.0
"""The public names of the package, and what importing it costs."""

from __future__ import annotations

from importlib import import_module
import subprocess
import sys

from launch._lazy import snake_case
import pytest

PACKAGES = (
    'launch',
    'launch.actions',
    'launch.conditions',
    'launch.descriptions',
    'launch.event_handlers',
    'launch.events',
    'launch.events.process',
    'launch.frontend',
    'launch.launch_description_sources',
    'launch.logging',
    'launch.substitutions',
    'launch.utilities',
)


@pytest.mark.parametrize('package', PACKAGES)
def test_every_public_name_can_be_imported(package: str) -> None:
    """Each name of `__all__` is there, and a class calls the module of its definition home."""
    module = import_module(package)
    assert module.__all__
    for name in module.__all__:
        assert getattr(module, name) is not None, name


@pytest.mark.parametrize(
    'name',
    [
        'launch.actions.include_launch_description.IncludeLaunchDescription',
        'launch.substitutions.path_join_substitution.PathJoinSubstitution',
        'launch.event_handlers.on_process_io.OnProcessIO',
        'launch.launch_context.LaunchContext',
        'launch.some_substitutions_type.SomeSubstitutionsType',
        'launch.utilities.type_utils.perform_typed_substitution',
    ],
)
def test_deep_paths(name: str) -> None:
    """A class is also found under its own module."""
    module, _, attribute = name.rpartition('.')
    assert hasattr(import_module(module), attribute)


def test_misspelt_name() -> None:
    """A name that is not there is answered with the closest one."""
    import launch.actions

    with pytest.raises(AttributeError, match="Did you mean: 'ExecuteProcess'"):
        _ = launch.actions.ExecutProcess


@pytest.mark.parametrize(
    'name, module',
    [('LogInfo', 'log_info'), ('SetROSLogDir', 'set_ros_log_dir'), ('Command', 'command')],
)
def test_snake_case(name: str, module: str) -> None:
    """A run of capitals counts as one word."""
    assert snake_case(name) == module


def test_bare_import_reaches_everything_and_loads_little() -> None:
    """`import launch` is enough for all sub-packages, and loads neither asyncio nor YAML."""
    code = (
        'import launch, sys; launch.actions.LogInfo(msg=launch.substitutions.LaunchConfiguration'
        '("x")); launch.actions.ExecuteProcess(cmd=["x"]); launch.LaunchDescription([]);'
        'bad = {"asyncio", "yaml", "rclpy", "subprocess"} & set(sys.modules); '
        'sys.exit(str(bad) if bad else 0)'
    )
    result = subprocess.run([sys.executable, '-c', code], stderr=subprocess.PIPE, text=True)
    assert (result.returncode, result.stderr) == (0, '')
