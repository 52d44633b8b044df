# SPDX-License-Identifier: Apache-2.0
"""Base class of recording errors."""


class BagError(RuntimeError):
    """A recording cannot be read or written; the text is a message for the user."""
