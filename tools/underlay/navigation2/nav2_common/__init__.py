# SPDX-License-Identifier: Apache-2.0
"""What launch files of navigation have in common."""
