# SPDX-License-Identifier: Apache-2.0
"""Error of the template process."""


class TemplateFailure(Exception):
    """The template cannot fork a process; the message states why."""
