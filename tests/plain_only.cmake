# What is left to the run without sanitizers, where everything runs: the same code on more or larger
# input than what stays, and comparisons with the oracles. By hand, a test program runs all it has.
set(plain_only
  # All laws on random scenarios; seeds and random scenarios behind the first of each kind.
  Every/*LawTest.Holds*
  *.HoldsOnRandomScenarios*
  *.AreTheSameFromRunToRun/*
  LawsOfAServer.NoticeMistakes
  Mistakes.*
  RandomScenario.*
  RandomScenarios/*
  Seeds/RandomRuns.OfAmendedRules*
  Seeds/*/1*
  Seeds/*/2
  Seeds/*/3
  Seeds/*/4
  Seeds/*/5
  Shrinking.EveryStep*
  Shrinking.KeepsATie
  Shrinking.NumbersGetRound
  Shrinking.PlantedFailure*
  Variety.*
  *ShippedScenarios.HaveTrueFindingsOnly*
  # Oracles.
  *OracleProperty*
  ChannelAgainstOracle.*
  Life.*Oracle*
  # Mistakes in rules and at effects.
  *IsMutated
  CycloneAcknowledgments.AreTrueInCorrectRuns
  FastDdsIsolation.IsBroken*
  FastDdsRecovery.OfWhoIsSomebodyNew*
  Followed.ADifference*
  Followed.AnotherEventThread*
  OtherSpecification.*
  *Followed.Mistakes*
  All/Mistakes.*
  CycloneObligations.*
  Variants/AnyMistake*
  # Runs that are followed, watched or recorded in another way once more.
  *Followed.*Runs*
  *Vectors.DeliverEvery*
  */DiscoveryVector.DeliversEvery*
  *6x30
  AccessPointTie.Units
  Amended.AreThePapersInRandomScenarios
  Both/PackingOf.KeepsItsContractInRandomRuns/1
  Cases/EffectsInRecordings.*
  Cases/PerfettoTest.*
  Cases/ReplayTest.*
  Cases/TraceMachinesTest.*
  Cases/TraceWriterTest.*
  Findings.*
  Followed.Lives*
  Implementations/EveryEffect*
  Life.EveryEffectHappens*
  Life.OfNobodyWhoFails*
  Lives/EffectsInRecordings.*
  Network.ARunIsTheSameWhetherSomebodyHearsOfItOrNot
  Parts/StatefulEngine*
  Perfetto.AnInterruptedRun*
  ProbeList.*
  Replay.AnInterruptedTrace*
  Replay.ATraceOfAnInterruptedRun*
  Replay.TheCallerCanStopIt
  TraceWriter.InterruptedRun*)
list(JOIN plain_only ":" plain_only)
