# SPDX-License-Identifier: Apache-2.0
"""The completion of command lines in bash and zsh; imported only when a shell asks for it."""

from ros2cli.completion.answering import answer

__all__ = ['answer']
