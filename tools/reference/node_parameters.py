# SPDX-License-Identifier: Apache-2.0
"""Describe the parameters of the project's nodes, as their dataclasses have them."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from typing import Any

NODES = {
    'humanoid_simulation simulator': (
        'humanoid_simulation.simulator_parameters.SimulatorParameters'
    ),
    'humanoid_simulation walk_square': (
        'humanoid_simulation.examples.walk_square.WalkSquareParameters'
    ),
    'humanoid_simulation push_test': 'humanoid_simulation.examples.push_test.PushTestParameters',
    'humanoid_simulation replay': 'humanoid_simulation.sweep.replay_node.ReplayParameters',
    'humanoid_control mock_robot': 'humanoid_control.hosting.parameters.HostParameters',
    'humanoid_control joint_controller': (
        'humanoid_control.joint_controller.JointControllerParameters'
    ),
    'humanoid_control sensor_processor': (
        'humanoid_control.sensor_processor.SensorProcessorParameters'
    ),
    'humanoid_perception object_detector': (
        'humanoid_perception.detector_choice.DetectorParameters'
    ),
    'humanoid_perception object_memory': 'humanoid_perception.memory_parameters.MemoryParameters',
    'humanoid_perception gaze': 'humanoid_perception.gaze_parameters.GazeParameters',
    'humanoid_manipulation manipulator': (
        'humanoid_manipulation.manipulation_node.ManipulatorParameters'
    ),
    'voice_control audio_source': 'voice_control.audio_source.AudioSourceParameters',
    'voice_control speech_recognizer': (
        'voice_control.recognizer_parameters.RecognizerParameters'
    ),
    'voice_control speaker': 'voice_control.speaker.SpeakerParameters',
    'llm_planner task_planner': 'llm_planner.task_planner.PlannerParameters',
    'llm_planner skill_executor': 'llm_planner.knowledge.KnowledgeParameters',
    'robot_mcp robot_mcp': 'robot_mcp.robot_mcp.McpParameters',
    'robot_control description_reporter': (
        'robot_control.description_reporter.ReporterParameters'
    ),
    'temperature_monitor temp_publisher': (
        'temperature_monitor.temp_publisher.PublisherParameters'
    ),
    'temperature_monitor temp_analyzer': 'temperature_monitor.temp_analyzer.AnalyzerParameters',
}
"""The parameters of each executable that has some; their modules need no optional part."""

INTRODUCTION = """\
# The parameters of the nodes

Defaults are those without a configuration file; launch files may give others. What is *fixed* is
read when the node starts; all else may change while it runs. How to set them:
[how-to/look_inside.md](../how-to/look_inside.md#parameters).
"""


def lines() -> Iterator[str]:
    """Yield the lines of the page."""
    yield INTRODUCTION
    specs_of = import_module('humanoid_common.parameters').specs_of
    for node, path in NODES.items():
        module, _, name = path.rpartition('.')
        yield f'## ros2 run {node}\n'
        yield '| parameter | type | default | |'
        yield '|---|---|---|---|'
        for spec in specs_of(getattr(import_module(module), name)).values():
            yield _row(spec)
        yield ''


def _row(spec: Any) -> str:
    """Return the line of a parameter."""
    description = spec.rules.description + (' *Fixed.*' if spec.rules.read_only else '')
    cells = [f'`{spec.name}`', _kind(spec), _default(spec.default), description]
    return f'| {" | ".join(cells)} |'


def _kind(spec: Any) -> str:
    """Say what a parameter may be."""
    rules = spec.rules
    if rules.choices:
        kind = ', '.join(f'`{choice}`' for choice in rules.choices)
        return f'a list of {kind}' if spec.is_list else kind
    return spec.expected + _limits(rules.at_least, rules.at_most)


def _limits(at_least: float | None, at_most: float | None) -> str:
    if at_least is None and at_most is None:
        return ''
    if at_least is None:
        return f', up to {at_most:.10g}'
    return f', from {at_least:.10g}' + ('' if at_most is None else f' to {at_most:.10g}')


def _default(value: Any) -> str:
    if isinstance(value, tuple):
        return f'[{", ".join(_default(each) for each in value)}]'
    if isinstance(value, bool):
        return str(value).lower()
    return f'`{value}`' if isinstance(value, str) and value else str(value) or "''"
