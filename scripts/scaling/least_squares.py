# SPDX-License-Identifier: BSD-3-Clause
"""Non-negative least squares with named columns."""
import numpy as np


def nonnegative(columns, target, weights):
    """Coefficients >= 0 by name that bring the sum of `columns` (name: values) nearest to `target`, and the residual.

    Errors count times `weights`. Columns may differ by many powers of ten. Coefficients of 0 are left out.
    """
    from scipy.optimize import nnls  # a package of the tests: only the model needs it
    used = {name: np.asarray(values, float) * weights for name, values in columns.items() if np.any(values)}
    goal = np.asarray(target, float) * weights
    if not used:
        return {}, float(np.linalg.norm(goal))
    scales = [np.abs(values).max() for values in used.values()]
    found, residual = nnls(np.column_stack([values / scale for values, scale in zip(used.values(), scales)]), goal)
    return {name: value / scale for name, value, scale in zip(used, found, scales) if value > 0}, residual
