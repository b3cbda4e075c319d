# SPDX-License-Identifier: BSD-3-Clause
"""The modules behind scripts/scaling.py, which measures strong and weak scaling.

  sweep                                  reads the ini file, and makes the cases to run
  machine                                describes the machine on which the times are measured
  backends                               run a case: here, through SLURM, or on a simulated cluster
  record                                 holds the numbers of one run
  measure                                runs all cases alternately
  summary                                makes rows with efficiencies from the runs
  tables, plots, compare                 show the rows, and compare them with older ones
  model, traffic_model, model_report     fit the time as a sum of terms, check the fit, and extrapolate it
  least_squares                          fits the factors of the terms
  errors                                 has the exceptions that end a command

The folder sweeps holds ini files, and reference.csv the published times of TriMe++.
"""
