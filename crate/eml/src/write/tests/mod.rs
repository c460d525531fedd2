//! Written documents round trip, and the written form is canonical.

mod generate;

use super::*;
use crate::parse;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn what_is_written_reads_as_it_was(seed in any::<u64>(), clauses in 0_usize..12) {
        let document = generate::document(seed, clauses);
        let text = write(&document);
        let parsed = parse(&text);
        let read = normal_form(&parsed.document);
        prop_assert_eq!(
            &read, &normal_form(&document),
            "{}\n{:?}", text, parsed.diagnostics
        );
        prop_assert_eq!(write(&parsed.document), text);
    }
}

#[test]
fn the_text_is_canonical() {
    let source = "<!-- who -->\n<eml xmlns:x='urn:raconteur:eml:1'><head/><body>\n\
                  <!-- a --><SEQ><null/><!-- b --></SEQ>\n\
                  <event key=\"a'b\"><![CDATA[<&>]]></event><voice-text time='t+1-2m'>Hi \
                  <emph level='moderate'>you<!-- c --></emph><break msec='800'/></voice-text>\
                  <x:camera shot='closeup' time='5.0'/></body></eml><!-- end -->";
    let parsed = parse(source);
    assert_eq!(
        write_with_comments(&parsed.document, source),
        "<!-- who -->\n\
         <eml xmlns:r='urn:raconteur:eml:1'>\n\
         \x20 <body>\n\
         \x20   <!-- a -->\n\
         \x20   <seq time='0'>\n\
         \x20     <null time='0'/>\n\
         \x20     <!-- b -->\n\
         \x20   </seq>\n\
         \x20   <event time='0' type='a&apos;b'>&lt;&amp;&gt;</event>\n\
         \x20   <!-- c -->\n\
         \x20   <voice-text time='t-119'>Hi <emph>you</emph><break level='large'/></voice-text>\n\
         \x20   <r:camera time='5' shot='closeUp'/>\n\
         \x20 </body>\n\
         </eml>\n\
         <!-- end -->\n"
    );
}
