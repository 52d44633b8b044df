# SPDX-License-Identifier: Apache-2.0
"""Facts about the system, one subject per module, without any evaluation."""
