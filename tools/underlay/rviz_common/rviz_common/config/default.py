# SPDX-License-Identifier: Apache-2.0
"""The default configuration."""

from __future__ import annotations

from typing import Any

__all__ = ['default_values']


def default_values() -> dict[str, Any]:
    """Return the contents of a new file: a grid, and the usual panels and tools."""
    return {
        'Panels': [
            {'Class': 'rviz_common/Displays', 'Name': 'Displays'},
            {'Class': 'rviz_common/Selection', 'Name': 'Selection'},
            {'Class': 'rviz_common/Tool Properties', 'Name': 'Tool Properties'},
            {'Class': 'rviz_common/Views', 'Name': 'Views'},
            {'Class': 'rviz_common/Time', 'Name': 'Time'},
        ],
        'Visualization Manager': {
            'Class': '',
            'Displays': [_grid()],
            'Enabled': True,
            'Global Options': {
                'Background Color': '48; 48; 48',
                'Fixed Frame': 'map',
                'Frame Rate': 30,
            },
            'Name': 'root',
            'Tools': [
                {'Class': 'rviz_default_plugins/MoveCamera'},
                {'Class': 'rviz_default_plugins/Select'},
                {'Class': 'rviz_default_plugins/Measure', 'Line color': '128; 128; 0'},
                {
                    'Class': 'rviz_default_plugins/SetInitialPose',
                    'Covariance x': 0.25,
                    'Covariance y': 0.25,
                    'Covariance yaw': 0.06853891909122467,
                    'Topic': _topic('/initialpose'),
                },
                {'Class': 'rviz_default_plugins/SetGoal', 'Topic': _topic('/goal_pose')},
                {
                    'Class': 'rviz_default_plugins/PublishPoint',
                    'Single click': True,
                    'Topic': _topic('/clicked_point'),
                },
            ],
            'Transformation': {'Current': {'Class': 'rviz_default_plugins/TF'}},
            'Value': True,
            'Views': {'Current': _view(), 'Saved': None},
        },
    }


def _grid() -> dict[str, Any]:
    return {
        'Alpha': 0.5,
        'Cell Size': 1,
        'Class': 'rviz_default_plugins/Grid',
        'Color': '160; 160; 164',
        'Enabled': True,
        'Line Style': {'Line Width': 0.03, 'Value': 'Lines'},
        'Name': 'Grid',
        'Normal Cell Count': 0,
        'Offset': {'X': 0, 'Y': 0, 'Z': 0},
        'Plane': 'XY',
        'Plane Cell Count': 10,
        'Reference Frame': '<Fixed Frame>',
        'Value': True,
    }


def _view() -> dict[str, Any]:
    return {
        'Class': 'rviz_default_plugins/Orbit',
        'Distance': 5,
        'Focal Point': {'X': 0, 'Y': 0, 'Z': 0},
        'Name': 'Current View',
        'Near Clip Distance': 0.01,
        'Pitch': 0.5,
        'Target Frame': '<Fixed Frame>',
        'Value': 'Orbit (rviz)',
        'Yaw': 0.785,
    }


def _topic(name: str) -> dict[str, Any]:
    return {
        'Depth': 5,
        'Durability Policy': 'Volatile',
        'History Policy': 'Keep Last',
        'Reliability Policy': 'Reliable',
        'Value': name,
    }
