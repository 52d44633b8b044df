# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 daemon stop`."""

from __future__ import annotations

from ros2daemon.verb import AnswerVerb


class StopVerb(AnswerVerb):
    """Stop the daemon if it is running."""
