# SPDX-License-Identifier: Apache-2.0
"""Turn what somebody says into a plan, and do it."""
