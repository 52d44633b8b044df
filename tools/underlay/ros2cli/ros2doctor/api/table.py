# SPDX-License-Identifier: Apache-2.0
"""The checks and reports of this package, in the order of their output."""

from __future__ import annotations

from ros2cli.entry import Entry

CHECK_GROUP = 'ros2doctor.checks'
REPORT_GROUP = 'ros2doctor.report'
WORKSPACE = 'workspace'

CHECKS = {
    'environment': Entry('ros2doctor.check.environment:EnvironmentCheck', ''),
    'wheels': Entry('ros2doctor.check.wheels:WheelsCheck', ''),
    'libraries': Entry('ros2doctor.check.libraries:LibrariesCheck', ''),
    'scripts': Entry('ros2doctor.check.scripts:ScriptsCheck', ''),
    WORKSPACE: Entry('ros2doctor.check.workspace:WorkspaceCheck', ''),
    'network': Entry('ros2doctor.check.network:NetworkCheck', ''),
    'graphics': Entry('ros2doctor.check.graphics:GraphicsCheck', ''),
    'rclpy': Entry('ros2doctor.check.client_library:ClientLibraryCheck', ''),
    'qos': Entry('ros2doctor.check.qos:QosCheck', ''),
    'nodes': Entry('ros2doctor.check.nodes:NodesCheck', ''),
    'neighbours': Entry('ros2doctor.check.neighbours:NeighboursCheck', ''),
    'clock': Entry('ros2doctor.check.clock:ClockCheck', ''),
    'frames': Entry('ros2doctor.check.frames:FramesCheck', ''),
    'diagnostics': Entry('ros2doctor.check.diagnostics:DiagnosticsCheck', ''),
}
REPORTS = {
    'platform': Entry('ros2doctor.report.machine:PlatformReport', ''),
    'environment': Entry('ros2doctor.report.environment:EnvironmentReport', ''),
    'wheels': Entry('ros2doctor.report.wheels:WheelsReport', ''),
    'libraries': Entry('ros2doctor.report.libraries:LibrariesReport', ''),
    'scripts': Entry('ros2doctor.report.scripts:ScriptsReport', ''),
    WORKSPACE: Entry('ros2doctor.report.workspace:WorkspaceReport', ''),
    'network': Entry('ros2doctor.report.network:NetworkReport', ''),
    'graphics': Entry('ros2doctor.report.graphics:GraphicsReport', ''),
    'nodes': Entry('ros2doctor.report.nodes:NodesReport', ''),
    'qos': Entry('ros2doctor.report.qos:QosReport', ''),
    'frames': Entry('ros2doctor.report.frames:FramesReport', ''),
}
