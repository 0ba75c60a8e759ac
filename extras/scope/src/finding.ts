// sbus::Finding
export enum Finding {
  NoSignal,
  NoFrames,
  Channels24,
  WrongPolarity,
  WrongBaud,
  WrongPolarityAndBaud,
  PolledTooSeldom,
  InterruptsOff,
  Noise,
  Failsafe,
  NoRadio,
  Lossy,
  AllWellAndMore,
  AllWell,
}
