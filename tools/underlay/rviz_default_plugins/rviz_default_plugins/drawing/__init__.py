# SPDX-License-Identifier: Apache-2.0
"""What displays draw with."""
