/** Gestures to begin with. */

const frame = (name: string, phases: string): string => `<eml xmlns:r="urn:raconteur:eml:1" name="${name}">
  <body>
    <gesture-is-on time="0" isOn="true"/>
    <seq time="0.9">
${phases.trim().replace(/^/gm, '      ')}
    </seq>
  </body>
</eml>
`;

/** Their names and texts. */
export const EXAMPLES: Readonly<Record<string, string>> = {
  Wave: frame(
    'wave',
    `
<gesture-key time="0" duration="0.7" handedness="right" r:phase="preparation">
  <hand-shapes>
    <key id="4"/>
  </hand-shapes>
  <palms>
    <key a="160" x="0" y="0" z="-1"/>
  </palms>
  <motion>
    <key x="-16" y="34" z="-8"/>
  </motion>
</gesture-key>
<gesture-key time="0" duration="1.2" handedness="right" r:phase="stroke">
  <palms r:interpolation="cosine">
    <key time="0" a="160" x="0" y="0" z="-1"/>
    <key time="33%" a="205" x="0" y="0" z="-1"/>
    <key time="66%" a="155" x="0" y="0" z="-1"/>
    <key time="100%" a="195" x="0" y="0" z="-1"/>
  </palms>
  <motion r:interpolation="cosine">
    <key time="0" x="-16" y="34" z="-8"/>
    <key time="33%" x="-12" y="34" z="-8"/>
    <key time="66%" x="-17" y="34" z="-8"/>
    <key time="100%" x="-13" y="34" z="-8"/>
  </motion>
</gesture-key>
<gesture-key time="0" duration="0.2" handedness="right" r:phase="poststroke"/>
<gesture-key time="0" duration="0.9" handedness="right" r:phase="retraction"/>`,
  ),
  Point: frame(
    'point',
    `
<gesture-key time="0" duration="0.6" handedness="right" r:phase="preparation">
  <motion>
    <key x="-10" y="18" z="-10"/>
  </motion>
</gesture-key>
<gesture-key time="0" duration="0.35" handedness="right" r:phase="stroke">
  <hand-shapes>
    <key time="100%" id="19"/>
  </hand-shapes>
  <palms>
    <key time="100%" a="80" x="0.4" y="-0.9" z="0"/>
  </palms>
  <motion r:interpolation="bezier" r:controls="0.5 0 0.2 1.15">
    <key time="0" x="-10" y="18" z="-10"/>
    <key time="100%" x="-14" y="24" z="-18"/>
  </motion>
</gesture-key>
<gesture-key time="0" duration="0.8" handedness="right" r:phase="poststroke"/>
<gesture-key time="0" duration="0.8" handedness="right" r:phase="retraction"/>`,
  ),
  'Open hands': frame(
    'open-hands',
    `
<gesture-key time="0" duration="0.7" handedness="both" r:phase="preparation">
  <hand-shapes>
    <key id="13"/>
  </hand-shapes>
  <palms>
    <key a="90" x="0.6" y="0.7" z="0"/>
  </palms>
  <motion>
    <key x="-5" y="15" z="-12"/>
  </motion>
</gesture-key>
<gesture-key time="0" duration="0.6" handedness="both" r:phase="stroke">
  <hand-shapes>
    <key time="100%" id="4"/>
  </hand-shapes>
  <palms>
    <key time="100%" a="60" x="0" y="1" z="0"/>
  </palms>
  <motion>
    <key time="0" x="-5" y="15" z="-12"/>
    <key time="100%" x="-15" y="14" z="-13"/>
  </motion>
</gesture-key>
<gesture-key time="0" duration="0.7" handedness="both" r:phase="poststroke"/>
<gesture-key time="0" duration="0.9" handedness="both" r:phase="retraction"/>`,
  ),
  'Only a stroke': frame(
    'stroke',
    `
<gesture-key time="0" duration="0.4" handedness="right" r:phase="stroke">
  <hand-shapes>
    <key time="0" id="24"/>
  </hand-shapes>
  <motion>
    <key time="0" x="-9" y="22" z="-13"/>
    <key time="100%" x="-10" y="16" z="-14"/>
  </motion>
</gesture-key>
<gesture-key time="0.3" duration="0.8" handedness="right" r:phase="retraction"/>`,
  ),
};
