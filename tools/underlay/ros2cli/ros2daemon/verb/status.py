# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 daemon status`."""

from __future__ import annotations

from ros2daemon.verb import AnswerVerb


class StatusVerb(AnswerVerb):
    """Output the status of the daemon."""
