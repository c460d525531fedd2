/** The code examples of the page, and the buttons that copy them. */

/** Small example story; stored here so that its angle brackets stay readable. */
const EXAMPLE = `<eml name="hello">
  <body>
    <gesture-is-on time="0" isOn="true"/>
    <voice-text time="0" timeId="hello">
      <div>Hello <emph><tm name="w" event="onStart"/>world!</emph></div>
    </voice-text>
    <gesture-key time="w" duration="0.2" handedness="right">
      <hand-shapes><key time="0" id="7"/></hand-shapes>
      <motion coords="speaker">
        <key time="0" x="-15" y="40" z="3"/>
      </motion>
    </gesture-key>
  </body>
</eml>`;

const write = document.querySelector('#write-code');
if (write !== null) write.textContent = EXAMPLE;

for (const button of document.querySelectorAll<HTMLButtonElement>('.copy')) {
  button.addEventListener('click', () => {
    const text = document.getElementById(button.dataset['copies'] ?? '')?.textContent ?? '';
    void navigator.clipboard.writeText(text).then(
      () => {
        button.textContent = 'Copied';
        setTimeout(() => (button.textContent = 'Copy'), 1600);
      },
      () => (button.textContent = 'Select and copy by hand'),
    );
  });
}
