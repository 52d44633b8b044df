# SPDX-License-Identifier: Apache-2.0
"""The public names of the package, and what importing it costs."""

from __future__ import annotations

from importlib import import_module
import subprocess
import sys

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
        'launch.event_handlers.on_process_exit.OnProcessExit',
        'launch.event_handlers.on_process_io.OnProcessIO',
        'launch.event_handlers.on_process_start.OnProcessStart',
        'launch.launch_context.LaunchContext',
        'launch.some_substitutions_type.SomeSubstitutionsType',
        'launch.utilities.type_utils.perform_typed_substitution',
        'launch.actions.append_environment_variable.AppendEnvironmentVariable',
        'launch.actions.opaque_coroutine.OpaqueCoroutine',
        'launch.actions.reset_launch_configurations.ResetLaunchConfigurations',
        'launch.actions.set_environment_variable.SetEnvironmentVariable',
        'launch.actions.set_launch_configuration.SetLaunchConfiguration',
        'launch.actions.unregister_event_handler.UnregisterEventHandler',
        'launch.actions.unset_environment_variable.UnsetEnvironmentVariable',
        'launch.actions.unset_launch_configuration.UnsetLaunchConfiguration',
        'launch.actions.pop_environment.PopEnvironment',
        'launch.actions.pop_launch_configurations.PopLaunchConfigurations',
        'launch.actions.push_environment.PushEnvironment',
        'launch.actions.push_launch_configurations.PushLaunchConfigurations',
        'launch.actions.reset_environment.ResetEnvironment',
        'launch.conditions.evaluate_condition_expression_impl.evaluate_condition_expression',
        'launch.conditions.if_condition.IfCondition',
        'launch.conditions.launch_configuration_equals.LaunchConfigurationEquals',
        'launch.conditions.launch_configuration_not_equals.LaunchConfigurationNotEquals',
        'launch.conditions.unless_condition.UnlessCondition',
        'launch.event_handlers.event_named.event_named',
        'launch.events.execution_complete.ExecutionComplete',
        'launch.events.include_launch_description.IncludeLaunchDescription',
        'launch.events.matchers.matches_action',
        'launch.events.process.process_exited.ProcessExited',
        'launch.events.process.process_io.ProcessIO',
        'launch.events.process.process_matchers.matches_pid',
        'launch.events.process.process_started.ProcessStarted',
        'launch.events.process.process_stderr.ProcessStderr',
        'launch.events.process.process_stdin.ProcessStdin',
        'launch.events.process.process_stdout.ProcessStdout',
        'launch.events.process.process_targeted_event.ProcessTargetedEvent',
        'launch.events.process.running_process_event.RunningProcessEvent',
        'launch.events.process.shutdown_process.ShutdownProcess',
        'launch.events.process.signal_process.SignalProcess',
        'launch.events.shutdown.Shutdown',
        'launch.events.timer_event.TimerEvent',
        'launch.launch_description_sources.any_launch_file_utilities'
        '.get_launch_description_from_any_launch_file',
        'launch.launch_description_sources.frontend_launch_file_utilities'
        '.get_launch_description_from_frontend_launch_file',
        'launch.launch_description_sources.python_launch_file_utilities'
        '.get_launch_description_from_python_launch_file',
        'launch.substitutions.not_equals_substitution.NotEqualsSubstitution',
        'launch.substitutions.path_substitution.PathSubstitution',
        'launch.substitutions.this_launch_file_dir.ThisLaunchFileDir',
        'launch.substitutions.substitution_failure.SubstitutionFailure',
        'launch.utilities.class_tools_impl.is_a',
        'launch.utilities.ensure_argument_type_impl.ensure_argument_type',
        'launch.utilities.normalize_to_list_of_entities_impl.normalize_to_list_of_entities',
        'launch.utilities.normalize_to_list_of_substitutions_impl'
        '.normalize_to_list_of_substitutions',
        'launch.utilities.perform_substitutions_impl.perform_substitutions',
        'launch.utilities.visit_all_entities_and_collect_futures_impl'
        '.visit_all_entities_and_collect_futures',
    ],
)
def test_deep_paths(name: str) -> None:
    """A class is also found in the module that ROS 2 Jazzy has for it, in a fresh process too."""
    module, _, attribute = name.rpartition('.')
    assert hasattr(import_module(module), attribute)
    code = f'import {module}; from {module} import {attribute}'
    result = subprocess.run([sys.executable, '-c', code], stderr=subprocess.PIPE, text=True)
    assert (result.returncode, result.stderr) == (0, '')


def test_misspelt_name() -> None:
    """A name that is not there is answered with the closest one."""
    import launch.actions

    with pytest.raises(AttributeError, match="Did you mean: 'ExecuteProcess'"):
        _ = launch.actions.ExecutProcess


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
