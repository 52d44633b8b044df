# SPDX-License-Identifier: Apache-2.0
"""Command line completion for bash and zsh; imported only when a shell requests it."""

from ros2cli.completion.answering import answer

__all__ = ['answer']
