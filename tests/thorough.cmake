# What the first gate leaves to the slices of tests/run, and sanitized tests to plain ones: the same
# code on more or larger input than what stays, comparisons with the oracles on random scenarios,
# mistakes in rules. Cases of GoogleTest; files whose cases are all of this kind are named in
# CMakeLists.txt, behind THOROUGH. By hand, a test program runs all it has.
set(thorough
  # Whole searches for settings, beside short ones.
  Fleets/TuneInLittleTime.*
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
  Perfetto.AnInterruptedRun*
  ProbeList.*
  Replay.AnInterruptedTrace*
  Replay.ATraceOfAnInterruptedRun*
  Replay.TheCallerCanStopIt
  TraceWriter.InterruptedRun*
  # The oracles themselves, mutated, and random scenarios in both.
  Assumptions.AreMissed*
  MutatedOracle.*
  MutatedProduct.*
  MutatedRows.*
  RandomCycloneScenario.*
  RandomFastddsScenario.*
  RandomVersions.*
  Ways/RandomDiscovery.*
  # Mutants of all properties; examples of the help, all verbs in all ways.
  Mutate.*
  Mutants.*
  Rules/MutatedRule.*
  # Captures of random runs, and captures with mistakes.
  CycloneRandom.*
  ServerRandom.*
  SimulatedRandom.*
  WriteRandom.*
  WriteRandomWithServer.*
  Damage/Formats.*
  DamagedCapture.*
  Changed/*
  Edited/*
  Impossible/Histories.AreRejectedManyTimes/*
  OfClients/ServerMistake.*
  OfServer/ServerMistake.*)
list(JOIN thorough ":" thorough)
