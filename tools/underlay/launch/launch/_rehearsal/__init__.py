# SPDX-License-Identifier: Apache-2.0
"""Visit a launch description without starting anything, and show what was found."""
