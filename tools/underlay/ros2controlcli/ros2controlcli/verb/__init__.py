# SPDX-License-Identifier: Apache-2.0
"""The verbs of `ros2 control`, one per module."""

from ros2cli.verb import VerbExtension

__all__ = ['VerbExtension']
