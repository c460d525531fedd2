//! Script for benchmarks and cost tests.

use std::fmt::Write as _;

/// A script as a person would write it: speech, gestures that hang on its words,
/// groups and events.
pub(crate) fn script(clauses: usize) -> String {
    let mut out = String::from("<eml name='bench'>\n <body>\n");
    for i in 0..clauses / 5 {
        let before = i * 4;
        let _ = write!(
            out,
            "  <voice-text time='{before}' timeId='v{i}'>
   <div type='sentence'>Once upon a time there was a <tm name='w{i}'/>small <emph>white</emph>
   rabbit, who went to the garden to fetch some cabbages for her soup.</div>
  </voice-text>
  <gesture-key time='w{i}-0.1s' duration='0.8' handedness='right'>
   <hand-shapes><key time='0' id='7'/></hand-shapes>
   <palms><key time='0' a='200' x='0.0' y='0.0' z='-1.0'/></palms>
   <motion coords='speaker'>
    <key time='0' x='-7.0' y='45.0' z='3.0'/>
    <key time='50%' x='-15.0' y='40.0' z='3.0'/>
   </motion>
  </gesture-key>
  <seq time='v{i}+1'>
   <event time='0.5' type='cue'>lights</event>
   <null time='1'/>
  </seq>
"
        );
    }
    out.push_str(" </body>\n</eml>\n");
    out
}
